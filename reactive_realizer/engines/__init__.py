"""The engines of all modalities. They do not import each other or the scheduler."""
