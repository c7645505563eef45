"""Speech from sound files: its text and sound are given, and the times of words and sounds are found."""
