"""Several motions as one: each shifted, stretched and weighed in and out, one on top of the other.

It knows its parts as motions, whatever plays them; makers hand them in.
"""
