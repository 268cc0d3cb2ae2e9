// The controls of a player: a slider, a button that plays, and what is told of the present step.

import { h, say } from "../dom.js";
import { textOf } from "../format.js";

export function playerControls(app, { player: index, steps, off }) {
  const player = app.players[index];
  const shift = player.optional ? 1 : 0;
  const last = steps.length - 1;
  const slider = h("input", {
    type: "range", "data-control": "step", min: 0, max: Math.max(0, last + shift), step: 1, disabled: last < 0, "aria-label": player.label,
    oninput: () => {
      // Stopping brings the slider up to date, too.
      const wanted = slider.valueAsNumber - shift;
      player.stop();
      player.set(wanted);
    },
  });
  const play = h("button", { type: "button", "data-control": "play", disabled: last < 0, onclick: () => (player.playing ? player.stop() : player.play(last)) }, "Play");
  const text = h("output", { "data-key": "step-text", class: "step-text" });
  const update = () => {
    const position = Math.min(player.position, last);
    slider.value = String(position + shift);
    const said = position < 0 ? textOf(off) : textOf(steps[position]);
    say(text, said);
    say(play, player.playing ? "Pause" : "Play");
    slider.setAttribute("aria-valuetext", said);
  };
  return { element: h("div", { class: "group player" }, h("div", { class: "slider" }, slider, play), text), update };
}
