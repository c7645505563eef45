import { create, element } from "../dom";

/** Most pictures of a character that stay loaded. */
const MOST = 300;

/** Pictures over the scene, those of several characters beside each other. */
export class PicturesPanel {
  private readonly holder = element("pictures", HTMLElement);
  private readonly figures = new Map<string, PictureFigure>();

  /**
   * Shows the files of each character, from the lowest to the uppermost; called once an animation frame. With bodies in
   * the scene, they are on its left.
   */
  show(files: Map<string, string[]>, bodies: boolean): void {
    this.holder.classList.toggle("beside", bodies);
    for (const [character, figure] of this.figures) {
      if (files.has(character)) continue;
      figure.object.remove();
      this.figures.delete(character);
    }
    for (const [character, own] of files) {
      let figure = this.figures.get(character);
      if (figure === undefined) {
        figure = new PictureFigure(character);
        this.figures.set(character, figure);
        this.holder.append(figure.object);
      }
      figure.show(own);
    }
  }

  /** Resolves when all that is shown is loaded; rejects if a picture cannot be shown. */
  async loaded(): Promise<void> {
    await Promise.all([...this.figures.values()].map((figure) => figure.loaded()));
  }
}

/** The pictures of a character. Those that were shown once stay loaded, so that they appear at once. */
class PictureFigure {
  readonly object: HTMLElement;
  private readonly pictures = new Map<string, HTMLImageElement>();
  private shown: string[] = [];

  constructor(character: string) {
    this.object = create("div", "picture-figure");
    this.object.role = "img";
    this.object.ariaLabel = character;
  }

  show(files: string[]): void {
    if (files.join("\n") === this.shown.join("\n")) return;
    this.shown = files;
    for (const picture of this.pictures.values()) picture.hidden = true;
    for (const [layer, file] of files.entries()) {
      const picture = this.picture(file);
      picture.hidden = false;
      picture.style.zIndex = String(layer);
    }
  }

  async loaded(): Promise<void> {
    await Promise.all(this.shown.map((file) => this.picture(file).decode()));
  }

  /** Removes the picture that is hidden and was loaded first, if there are too many. */
  private forgetOne(): void {
    if (this.pictures.size <= MOST) return;
    for (const [file, picture] of this.pictures) {
      if (this.shown.includes(file)) continue;
      picture.remove();
      this.pictures.delete(file);
      return;
    }
  }

  private picture(file: string): HTMLImageElement {
    let picture = this.pictures.get(file);
    if (picture === undefined) {
      picture = create("img");
      picture.alt = "";
      picture.src = `pictures/${file.split("/").map(encodeURIComponent).join("/")}`;
      this.pictures.set(file, picture);
      this.object.append(picture);
      this.forgetOne();
    }
    return picture;
  }
}
