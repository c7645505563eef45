import { element, sentenceOf } from "../dom";

/** How long a notice stays, ms. */
const NOTICE_STAYS = 8000;

/** The connection light, the version, and notices of failures. */
export class StatusPanel {
  private readonly light = element("light", HTMLElement);
  private readonly connection = element("connection", HTMLElement);
  private readonly version = element("version", HTMLElement);
  private readonly notice = element("notice", HTMLElement);
  private timer: ReturnType<typeof setTimeout> | undefined;

  connected(version: string): void {
    this.show("connected");
    this.version.textContent = version;
  }

  lost(): void {
    this.show("reconnecting");
  }

  /** Reports a failure that the page cannot recover from. */
  failed(reason: unknown): void {
    this.show("failed");
    this.notice.textContent = `The page could not start: ${sentenceOf(reason)}`;
    this.notice.hidden = false;
  }

  /** Shows a failure for a few seconds. */
  report = (reason: unknown): void => {
    this.notice.textContent = sentenceOf(reason);
    this.notice.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.notice.hidden = true;
    }, NOTICE_STAYS);
  };

  private show(state: "connected" | "reconnecting" | "failed"): void {
    this.light.dataset.state = state;
    this.connection.textContent = state;
  }
}
