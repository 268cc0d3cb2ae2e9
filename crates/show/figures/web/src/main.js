// Opens the page that the data in it describe.

import "./style.css";
import { App } from "./app.js";
import * as format from "./format.js";
import { load } from "./load.js";
import { failure } from "./shell.js";

/** The page around this one, if there is one, may say from where to look, also before there is anything to see. */
let app;
let asked;
addEventListener("message", ({ data, source }) => {
  if (source !== parent || parent === window || data?.pompeiu !== "cameras") return;
  asked = data.cameras;
  app?.look(asked);
});

async function start() {
  const holder = document.getElementById("data");
  const data = JSON.parse(holder.textContent);
  // The text is large and never needed again.
  holder.remove();
  app = new App(data, await load(data));
  if (asked) app.look(asked);
  globalThis.pompeiu = { app, format };
  // Ready means drawn: the frame that was asked for last is on the screen.
  const drawn = () => {
    if (app.view && app.view.element.dataset.state !== "still") return void requestAnimationFrame(drawn);
    document.documentElement.dataset.ready = "true";
    app.begin();
  };
  drawn();
}

start().catch((error) => {
  failure(error);
  throw error;
});
