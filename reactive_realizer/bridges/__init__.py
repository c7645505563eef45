"""Clients of the protocol of a realizer that connect it with other systems, as plug-ins do."""
