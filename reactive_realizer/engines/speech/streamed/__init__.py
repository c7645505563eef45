"""Speech whose sound a client streams: the times of its words and sounds are found while it arrives."""
