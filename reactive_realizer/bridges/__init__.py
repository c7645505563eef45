"""Programs between a realizer and message buses of other systems; each is a client of the realizer's protocol."""
