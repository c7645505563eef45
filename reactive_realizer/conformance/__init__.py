"""A conformance suite that tests any realizer through the protocol (thesis ch. 9).

This package is a client of the protocol. It uses the packages for BML and feedback, and no other part of the realizer.
"""
