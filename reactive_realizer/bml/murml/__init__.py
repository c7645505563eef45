"""MURML: gestures as constraints of hands and as key frames, and key frames of the face."""
