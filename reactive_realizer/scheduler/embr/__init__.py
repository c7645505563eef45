"""The strategy `embr`: least deviation from preferred durations, by a linear program (thesis 7.2.3)."""
