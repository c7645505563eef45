"""What tests of a realizer need, ours and those of plug-ins: a pilot that owns the clock and reads the feedback."""
