// SPDX-License-Identifier: Apache-2.0
// The row of buttons above the lanes: play, step, jump, and where one is.

import { button, by_id, element } from "./elements";
import type { Session } from "./session";

const kRates = [0.25, 1, 2, 4, 10, 30, 100];

export class Transport {
  private readonly play: HTMLButtonElement;
  private readonly tick = element("input", { id: "tick", type: "number", min: "0", "aria-label": "Tick" });
  private readonly clock = element("output", { id: "clock" });
  private readonly slider = element("input", { id: "slider", type: "range", min: "0", step: "1", "aria-label": "Tick" });
  private readonly rate = element("select", { id: "rate", "aria-label": "Speed" });

  constructor(private readonly session: Session) {
    this.play = button("Play", "Play or pause (space)", () => session.set_playing(!session.playing));
    this.play.id = "play";
    for (const rate of kRates) this.rate.append(element("option", { value: String(rate) }, `${rate}×`));
    this.rate.value = String(session.rate);
    this.rate.addEventListener("change", () => {
      session.rate = Number(this.rate.value);
    });
    this.tick.addEventListener("change", () => session.go_to(Number(this.tick.value)));
    this.slider.addEventListener("input", () => session.go_to(Number(this.slider.value)));
    by_id("transport").append(
      button("|‹", "First tick (Home)", () => session.go_to(session.first_tick)),
      button("‹ event", "The event before (p)", () => this.jump(false)),
      button("‹", "A tick back (←)", () => session.go_to(session.tick - 1)),
      this.play,
      button("›", "A tick on (→)", () => session.go_to(session.tick + 1)),
      button("event ›", "The next event (n)", () => this.jump(true)),
      button("›|", "Last tick (End)", () => session.go_to(session.last_tick)),
      element("label", {}, "tick ", this.tick), this.clock, this.slider,
      element("label", {}, "speed ", this.rate));
    session.listen(() => this.show());
  }

  jump(forward: boolean): void {
    const tick = this.session.event_tick(forward);
    if (tick !== undefined) this.session.go_to(tick);
  }

  change_rate(faster: boolean): void {
    const at = kRates.indexOf(this.session.rate);
    this.session.rate = kRates[Math.max(0, Math.min(kRates.length - 1, at + (faster ? 1 : -1)))] ?? 4;
    this.rate.value = String(this.session.rate);
  }

  private show(): void {
    const { session } = this;
    const first = Number.isFinite(session.first_tick) ? session.first_tick : 0;
    this.play.textContent = session.playing ? "Pause" : "Play";
    if (document.activeElement !== this.tick) this.tick.value = String(session.tick);
    this.tick.max = this.slider.max = String(session.last_tick);
    this.slider.min = String(first);
    this.slider.value = String(session.tick);
    this.clock.textContent = `${(session.tick * (session.run?.tick_s ?? 0)).toFixed(1)} s of ` +
      `${(session.last_tick * (session.run?.tick_s ?? 0)).toFixed(1)} s`;
  }
}
