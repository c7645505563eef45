"""How the world talks to a realizer: HTTP, a socket, frames and sounds, from one scene to many clients.

The room adapts and decides nothing: what is said enters as inputs of the realizer, what comes out is passed on. It may
not know how anything is planned or played.
"""
