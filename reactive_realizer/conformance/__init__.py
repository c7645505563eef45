"""A conformance suite that tests any realizer through the protocol (thesis ch. 9).

The room is a client of the protocol. It uses the language and the feedback, and nothing else of this realizer.
"""
