"""Walking: a figure goes to another place in the world, and turns there, on feet that do not slide."""
