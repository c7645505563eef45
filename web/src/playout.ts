import { MathUtils, Quaternion } from "three";

import { emptyPose, type Frame, type Pose } from "./binary";
import { FURTHEST_FACE } from "./clock";

/** Most frames kept: two seconds at 50 frames a second, far more than the playout delay needs. */
const CAPACITY = 100;

/** Two frames, and the share of the second one in the pose between them. */
interface Between {
  from: Frame;
  to: Frame;
  ratio: number;
}

/**
 * The playout buffer of one character: takes frames as they arrive, and gives the pose at any time.
 *
 * Between two frames the pose is interpolated by their times; after the last one it holds. Frames are dropped when no
 * face can need them any more; without samples, the oldest ones.
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
   * The pose at a realizer time, with the face at another one, which is close to it (s); null before the first frame.
   * The next call overwrites it.
   *
   * Time must not go back: earlier frames are dropped.
   */
  sample(time: number, face = time): Pose | null {
    this.note(time);
    this.drop(time - FURTHEST_FACE);
    const [body, head] = [this.around(time), this.around(face)];
    return body === null || head === null ? null : this.between(body, head);
  }

  private note(time: number): void {
    for (const frame of this.frames) {
      if (frame.time > time || (this.lastTime !== null && frame.time <= this.lastTime)) continue;
      this.played++;
      this.lastTime = frame.time;
    }
  }

  /** Drops the frames before the last one at or before a time. */
  private drop(time: number): void {
    let passed = 0;
    while ((this.frames[passed + 1]?.time ?? Infinity) <= time) passed++;
    this.frames.splice(0, passed);
  }

  private around(time: number): Between | null {
    const next = this.frames.findIndex((frame) => frame.time > time);
    const to = this.frames.at(next);
    const from = this.frames[next - 1] ?? to;
    if (from === undefined || to === undefined) return null;
    return from === to || next < 0
      ? { from: to, to, ratio: 0 }
      : { from, to, ratio: (time - from.time) / (to.time - from.time) };
  }

  private between(body: Between, face: Between): Pose {
    const pose = this.poseLike(body.from);
    for (let i = 0; i < pose.rotations.length; i += 4) {
      this.target.fromArray(body.to.rotations, i);
      this.rotation.fromArray(body.from.rotations, i).slerp(this.target, body.ratio);
      this.rotation.toArray(pose.rotations, i);
    }
    interpolate(pose.root, body.from.root, body.to.root, body.ratio);
    interpolate(pose.weights, face.from.weights, face.to.weights, face.ratio);
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
