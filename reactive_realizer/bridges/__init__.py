"""Programs between a realizer and clients of other systems; each is a client of the realizer's protocol."""
