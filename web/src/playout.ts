import { MathUtils, Quaternion } from "three";

import { emptyPose, type Frame, type Pose } from "./binary";

/** Most frames kept: two seconds at 50 frames a second, far more than the playout delay needs. */
const CAPACITY = 100;

/**
 * The playout buffer of one character: takes frames as they arrive, and gives the pose at any time.
 *
 * Between two frames the pose is interpolated by their times; after the last one it holds. Past frames are dropped;
 * without samples, the oldest ones.
 */
export class Playout {
  /** Number of frames whose time has come, including those skipped between two samples. */
  played = 0;
  /** Time of the newest frame whose time has come, s. */
  lastTime: number | null = null;

  private frames: Frame[] = [];
  private pose = emptyPose(0, 0);
  private readonly rotation = new Quaternion();
  private readonly target = new Quaternion();

  /** Takes a frame; ignores one that is not newer than the last. */
  push(frame: Frame): void {
    const newest = this.frames.at(-1);
    if (newest !== undefined && frame.time <= newest.time) return;
    this.frames.push(frame);
    if (this.frames.length > CAPACITY) this.frames.shift();
  }

  /**
   * The pose at a realizer time (s); null before the first frame. The next call overwrites it.
   *
   * Time must not go back: earlier frames are dropped.
   */
  sample(time: number): Pose | null {
    this.dropPassed(time);
    const [from, to] = this.frames;
    if (from === undefined) return null;
    if (time >= from.time) this.note(from);
    if (to === undefined || time <= from.time) return from;
    return this.between(from, to, (time - from.time) / (to.time - from.time));
  }

  private dropPassed(time: number): void {
    let passed = 0;
    while (passed + 1 < this.frames.length && (this.frames[passed + 1]?.time ?? Infinity) <= time) passed++;
    for (const frame of this.frames.splice(0, passed)) this.note(frame);
  }

  private note(frame: Frame): void {
    if (this.lastTime !== null && frame.time <= this.lastTime) return;
    this.played++;
    this.lastTime = frame.time;
  }

  private between(from: Frame, to: Frame, ratio: number): Pose {
    const pose = this.poseLike(from);
    for (let i = 0; i < pose.rotations.length; i += 4) {
      this.rotation.fromArray(from.rotations, i).slerp(this.target.fromArray(to.rotations, i), ratio);
      this.rotation.toArray(pose.rotations, i);
    }
    interpolate(pose.weights, from.weights, to.weights, ratio);
    interpolate(pose.root, from.root, to.root, ratio);
    return pose;
  }

  private poseLike(frame: Frame): Pose {
    if (this.pose.rotations.length !== frame.rotations.length || this.pose.weights.length !== frame.weights.length) {
      this.pose = emptyPose(frame.rotations.length / 4, frame.weights.length);
    }
    return this.pose;
  }
}

function interpolate(result: Float32Array, from: Float32Array, to: Float32Array, ratio: number): void {
  for (let i = 0; i < result.length; i++) result[i] = MathUtils.lerp(from[i] ?? 0, to[i] ?? 0, ratio);
}
