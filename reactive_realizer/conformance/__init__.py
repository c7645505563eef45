"""What a planner may expect of a realizer, tried from outside (thesis ch. 9).

The room is a client of the protocol: it knows the language and feedback, and nothing of this realizer.
"""
