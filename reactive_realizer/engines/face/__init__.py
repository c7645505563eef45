"""The face: expressions, lids, and the mouth of whoever speaks, as weights of morph targets."""
