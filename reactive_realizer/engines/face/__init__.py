"""The face (thesis 8.8): expressions and the mouth of speech, as weights of ARKit's blend shapes."""
