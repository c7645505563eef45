"""The network interface of a realizer: HTTP, a WebSocket, frames and sounds, from one scene to many clients.

The room only adapts: requests enter as inputs of the realizer, and its output is passed on. It does not depend on how
behaviors are planned or played.
"""
