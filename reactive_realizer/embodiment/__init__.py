"""What can be moved, heard and shown: skeletons, avatars, poses and frames.

This room knows rotations, bones and how layers of motion become one pose. It does not know pegs, behaviors or engines,
and it never asks what time it is.

Frame of reference of everything here: right-handed, meters, y up; the figure stands at the origin, faces +z, its left
is +x. Joints have their H-Anim names, and the identity of every joint is the H-Anim default pose: standing, arms
hanging, palms to the thighs (ISO/IEC 19774). Rotations are unit quaternions w x y z, local to the parent joint.
"""
