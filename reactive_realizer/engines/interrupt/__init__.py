"""Cutting blocks and behaviors. The room knows their names, and neither them nor what becomes of them."""
