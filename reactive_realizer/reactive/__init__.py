"""Cells that change together: sources are written, derived cells follow, once each, in order.

The room knows no domain word, no task and no clock. Dependencies are declared, never discovered: an edge can be drawn,
explained, and survives an ``await``.
"""
