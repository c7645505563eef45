"""What a living figure does when it does nothing.

It knows times and chance; of behaviors, and of what else moves the body, it knows nothing.
"""
