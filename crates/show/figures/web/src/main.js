// Opens the page that the data in it describe.

import "./style.css";
import { openDeviation } from "./deviation.js";
import { openFields } from "./fields.js";
import * as format from "./format.js";

const OPEN = { deviation: openDeviation, fields: openFields };

async function start() {
  const holder = document.getElementById("data");
  const data = JSON.parse(holder.textContent);
  // The text is large and never needed again.
  holder.remove();
  const app = await OPEN[data.kind](data);
  globalThis.pompeiu = { app, format };
  // Ready means drawn: the frame that was asked for last is on the screen.
  const drawn = () => (app.view.element.dataset.state === "still" ? (document.documentElement.dataset.ready = "true") : requestAnimationFrame(drawn));
  drawn();
}

start();
