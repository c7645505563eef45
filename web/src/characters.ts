import type { Object3D } from "three";

import { Avatar } from "./avatar";
import type { Frame } from "./binary";
import { FaceClock } from "./clock";
import type { Figure } from "./framing";
import { Playout } from "./playout";
import type { Character, Position } from "./protocol";
import { Stool } from "./stool";
import type { Quality } from "./viewport";

/** A character of the scene; its avatar is null until it is loaded. */
interface LoadedCharacter {
  character: Character;
  playout: Playout;
  face: FaceClock;
  avatar: Avatar | null;
  stool: Stool;
}

/** All characters of the scene, as listed in the last `hello`. */
export class Characters {
  private byIndex = new Map<number, LoadedCharacter>();

  constructor(
    private readonly scene: Object3D,
    private readonly quality: Quality,
    private readonly onFailure: (reason: unknown) => void,
  ) {}

  /** Number of frames whose time has come, over all characters. */
  get framesPlayed(): number {
    return this.list().reduce((sum, { playout }) => sum + playout.played, 0);
  }

  /** Time of the newest frame shown, s. */
  get lastFrameTime(): number | null {
    const times = this.list().flatMap(({ playout }) => playout.lastTime ?? []);
    return times.length === 0 ? null : Math.max(...times);
  }

  /** Whether every character is in the scene with a pose. */
  get complete(): boolean {
    return this.byIndex.size > 0 && this.list().every(({ avatar }) => avatar?.object.parent);
  }

  /** Replaces the characters. An unchanged one keeps its avatar but loses its frames. */
  assign(characters: Character[]): void {
    const former = this.byIndex;
    this.byIndex = new Map();
    for (const character of characters) {
      const same = former.get(character.index);
      if (same !== undefined && JSON.stringify(same.character) === JSON.stringify(character)) {
        former.delete(character.index);
        same.playout = new Playout();
        this.byIndex.set(character.index, same);
      } else {
        this.add(character);
      }
    }
    for (const { avatar, stool } of former.values()) {
      avatar?.dispose();
      stool.remove();
    }
  }

  push(frame: Frame): void {
    this.byIndex.get(frame.character)?.playout.push(frame);
  }

  /**
   * Poses all characters as of a realizer time (s). An avatar enters the scene with its first pose.
   *
   * `heard` gives the time of the frame that shows what is heard of a character, null if nothing is.
   */
  show(time: number, heard: (character: string) => number | null): void {
    for (const { character, playout, face, avatar, stool } of this.byIndex.values()) {
      const pose = playout.sample(time, face.at(time, heard(character.id)));
      if (pose === null || avatar === null) continue;
      avatar.apply(pose, time);
      if (avatar.object.parent === null) this.scene.add(avatar.object);
      stool.show(avatar.seat);
    }
  }

  /** Hides the bodies of some characters, and shows those of all others; returns whether there are others. */
  hide(hidden: { has(id: string): boolean }): boolean {
    for (const { character, avatar } of this.list()) {
      if (avatar !== null) avatar.object.visible = !hidden.has(character.id);
    }
    return this.list().some(({ character }) => !hidden.has(character.id));
  }

  /** World position of a bone, m; null when there is no such character or bone, or the avatar is not loaded. */
  bone(characterId: string, name: string): Position | null {
    return this.find(characterId)?.bone(name) ?? null;
  }

  /** Where a character faces, horizontally, of length 1; null when there is none, or its avatar is not loaded. */
  forward(characterId: string): Position | null {
    return this.find(characterId)?.forward ?? null;
  }

  /** Weight of a morph; null as for a bone. */
  morph(characterId: string, name: string): number | null {
    return this.find(characterId)?.morph(name) ?? null;
  }

  /** The characters whose avatars are loaded, as the camera sees them. */
  figures(): Figure[] {
    return this.list().flatMap(({ avatar }) => (avatar === null ? [] : [avatar.figure]));
  }

  private list(): LoadedCharacter[] {
    return [...this.byIndex.values()];
  }

  private find(characterId: string): Avatar | null {
    return this.list().find(({ character }) => character.id === characterId)?.avatar ?? null;
  }

  private add(character: Character): void {
    const stool = new Stool(this.scene, this.quality);
    const added: LoadedCharacter = { character, playout: new Playout(), face: new FaceClock(), avatar: null, stool };
    this.byIndex.set(character.index, added);
    Avatar.load(character, this.quality).then(
      (avatar) => {
        if (this.byIndex.get(character.index) === added) added.avatar = avatar;
        else avatar.dispose();
      },
      () => {
        this.onFailure(`The avatar of ${character.id} could not be loaded.`);
      },
    );
  }
}
