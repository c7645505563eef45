"""Looking: how eyes, head and trunk share a turn (thesis 4.2.2)."""
