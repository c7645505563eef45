"""Controllers: they move physical joints by torques (thesis 3.2.4 and 4.2.3)."""
