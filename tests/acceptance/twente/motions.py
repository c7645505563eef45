"""Motions in files, and what frames and feedback show of them."""

import numpy as np

from reactive_realizer.testing.pilot import RealizerPilot

SWING = """
<ProcAnimation prefDuration="2">
  <Rotation target="r_shoulder" rotation="0 - 0.6 - a*sin(2*pi*t);0;0"/>
  <Rotation target="r_elbow" rotation="0 - 0.4 - 0.3*sin(2*pi*t);0;0"/>
  <Parameter sid="a" value="0.5"/>
  <KeyPosition id="beat1" time="0.25"/><KeyPosition id="beat2" time="0.75"/>
</ProcAnimation>
"""
KEYS = "0 1 0 0 0  1 1 0 0 -0.8  2 1 0 0 -0.2"
WAVE = f"""
<SkeletonInterpolator parts="r_shoulder" encoding="R" rotationEncoding="axisangles">
  <KeyPosition id="up" time="1" leave="true"/>{KEYS}
</SkeletonInterpolator>
"""
BOW = """HIERARCHY
ROOT Hips { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
 JOINT Spine { OFFSET 0 10 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT Head { OFFSET 0 50 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 10 0 } } }
 JOINT LeftUpLeg { OFFSET 9 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT LeftLeg { OFFSET 0 -44 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -44 0 } } }
 JOINT RightUpLeg { OFFSET -9 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT RightLeg { OFFSET 0 -44 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -44 0 } } } }
MOTION
Frames: 3
Frame Time: 0.5
0 98 0  0 0 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
0 98 0  0 0 0  0 30 0  0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
0 98 0  0 0 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0  0 0 0
"""
FILES = {"moves/swing.xml": SWING, "moves/wave.xml": WAVE, "captures/bow.bvh": BOW}
ARM = '<bmlt:parameter name="joints" value="r_shoulder,r_elbow r_wrist"/>'


def angles(pilot: RealizerPilot, joint: str, axis: int = 1) -> dict[float, float]:
    """Of each frame, by time: how far a joint is turned about x (1), y (2) or z (3), rad."""
    (frames,) = pilot.frames.values()
    index = next(iter(pilot.realizer.characters.values())).humanoid.avatar.skeleton.joints.index(joint)
    return {
        round(float(frame.time), 2): 2.0 * float(np.arctan2(frame.rotations[index][axis], frame.rotations[index][0]))
        for frame in frames
    }


def told(pilot: RealizerPilot) -> str:
    """The text of the first warning."""
    return pilot.feedback.of("warningFeedback")[0].text


def after_start(pilot: RealizerPilot, *points: str) -> list[float]:
    """How long after the start of its block points of block b came, s: it starts when its files have been read."""
    return [round(pilot.feedback.time(f"b:{point}") - pilot.feedback.time("b:start"), 6) for point in points]
