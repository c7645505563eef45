"""The body of a character: skeletons, avatars, poses, sound and frames.

This package knows rotations, bones and how layers of motion become one pose. It does not know pegs, behaviors or
engines, and it never reads a clock.

Frame of reference throughout: right-handed, meters, y up. The figure stands at the origin and faces +z; its left is +x.
Joints have H-Anim names, and all identity rotations together are the H-Anim default pose: standing, arms hanging, palms
to the thighs (ISO/IEC 19774). Rotations are unit quaternions w x y z, local to the parent joint.
"""
