"""Reactive cells: sources are written, and the cells that are computed from them follow, once each and in order.

This package has no domain terms, no tasks and no clock. Dependencies are declared, not discovered: so an edge can be
drawn and explained, and it survives an ``await``.
"""
