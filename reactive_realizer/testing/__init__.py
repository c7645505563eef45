"""Tools for tests of the realizer and of plug-ins: a pilot that advances the clock, assertions and contracts."""
