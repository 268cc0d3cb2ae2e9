// Opens the page that the data in it describe.

import "./style.css";
import { App } from "./app.js";
import * as format from "./format.js";
import { load } from "./load.js";
import { failure } from "./shell.js";

async function start() {
  const holder = document.getElementById("data");
  const data = JSON.parse(holder.textContent);
  // The text is large and never needed again.
  holder.remove();
  const app = new App(data, await load(data));
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
