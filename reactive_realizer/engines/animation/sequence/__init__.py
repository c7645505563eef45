"""Several motions as one: each shifted, stretched and weighed in and out, one on top of the other."""
