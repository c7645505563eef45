"""The network interface of a realizer: HTTP, a WebSocket, frames and sounds, from one scene to many clients.

This package only adapts: it converts requests to inputs of the realizer, and passes its output on. It does not depend
on how behaviors are planned or played.
"""
