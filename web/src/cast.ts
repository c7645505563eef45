import type { Object3D } from "three";

import { Avatar } from "./avatar";
import type { Frame } from "./frame";
import { Playout } from "./playout";
import type { Character, Position } from "./protocol";
import type { Quality } from "./quality";

/** A character of the scene: its frames at once, its avatar as soon as that is loaded. */
interface Member {
  character: Character;
  playout: Playout;
  avatar: Avatar | null;
}

/** All characters, as the last greeting named them. */
export class Cast {
  private members = new Map<number, Member>();

  constructor(
    private readonly scene: Object3D,
    private readonly quality: Quality,
    private readonly onFailure: (sentence: string) => void,
  ) {}

  /** Number of frames whose time has come, over all characters. */
  get framesPlayed(): number {
    return this.list().reduce((sum, member) => sum + member.playout.played, 0);
  }

  /** Stamp of the newest frame shown, s. */
  get lastFrameTime(): number | null {
    const times = this.list().flatMap((member) => member.playout.lastTime ?? []);
    return times.length === 0 ? null : Math.max(...times);
  }

  /** Whether every character stands in the scene with a pose. */
  get complete(): boolean {
    return this.members.size > 0 && this.list().every((member) => member.avatar?.object.parent);
  }

  /** Replaces the characters; one that stays the same keeps its avatar, but not its frames. */
  assign(characters: Character[]): void {
    const former = this.members;
    this.members = new Map();
    for (const character of characters) {
      const same = former.get(character.index);
      if (same !== undefined && JSON.stringify(same.character) === JSON.stringify(character)) {
        former.delete(character.index);
        same.playout = new Playout();
        this.members.set(character.index, same);
      } else {
        this.join(character);
      }
    }
    for (const member of former.values()) member.avatar?.dispose();
  }

  push(frame: Frame): void {
    this.members.get(frame.character)?.playout.push(frame);
  }

  /** Poses everyone as of a realizer time, s; a figure enters the scene with its first pose. */
  show(time: number): void {
    for (const { playout, avatar } of this.members.values()) {
      const pose = playout.sample(time);
      if (pose === null || avatar === null) continue;
      avatar.apply(pose);
      if (avatar.object.parent === null) this.scene.add(avatar.object);
    }
  }

  /** World position of a bone, m; null when there is no such character or bone, or it has not been seen yet. */
  bone(characterId: string, name: string): Position | null {
    return this.find(characterId)?.bone(name) ?? null;
  }

  /** Weight of a morph; null as for a bone. */
  morph(characterId: string, name: string): number | null {
    return this.find(characterId)?.morph(name) ?? null;
  }

  /** Where everyone's root is, m. */
  roots(): Position[] {
    return this.list().flatMap(({ avatar }) => (avatar === null ? [] : [avatar.position]));
  }

  private list(): Member[] {
    return [...this.members.values()];
  }

  private find(characterId: string): Avatar | null {
    return this.list().find((member) => member.character.id === characterId)?.avatar ?? null;
  }

  private join(character: Character): void {
    const member: Member = { character, playout: new Playout(), avatar: null };
    this.members.set(character.index, member);
    Avatar.load(character, this.quality).then(
      (avatar) => {
        if (this.members.get(character.index) === member) member.avatar = avatar;
        else avatar.dispose();
      },
      () => {
        this.onFailure(`The avatar of ${character.id} could not be loaded.`);
      },
    );
  }
}
