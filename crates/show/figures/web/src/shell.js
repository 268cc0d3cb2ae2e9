// What all pages have in common: the head with the title and the choice of theme, the place for the view, the side panel.

import { h } from "./dom.js";

const THEMES = [["auto", "Theme: as the system", "light dark"], ["light", "Theme: light", "light"], ["dark", "Theme: dark", "dark"]];

/** What kinds of answers are marked with, beside their colours. */
const SIGNS = { good: "\u2714", bad: "\u2718", open: "?" };

function bannerOf({ kind, head, text }) {
  return h("div", { class: `banner ${kind}`, id: "banner", role: "status" }, h("span", { class: "sign", "aria-hidden": "true" }, SIGNS[kind]),
    h("p", {}, h("strong", {}, head), " ", text));
}

export function shell({ title, subtitle, banner, toolbar, view, below, panel, onTheme }) {
  let theme = 0;
  const button = h("button", { type: "button", id: "theme", "data-control": "theme", onclick: () => setTheme((theme + 1) % THEMES.length) });
  const setTheme = (next) => {
    theme = next;
    const [name, text, scheme] = THEMES[theme];
    document.documentElement.dataset.theme = name;
    document.documentElement.style.colorScheme = scheme;
    button.textContent = { auto: "\u25d0", light: "\u2600", dark: "\u263e" }[name];
    button.setAttribute("aria-label", text);
    button.title = text;
    onTheme?.();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => onTheme?.());
  document.body.replaceChildren(
    h("a", { class: "skip", href: "#panel" }, "Skip to the numbers"),
    h("div", {}, banner && bannerOf(banner),
      h("header", {}, h("div", { class: "brand" }, h("h1", {}, title), h("p", {}, subtitle)), button)),
    h("main", { class: view ? undefined : "plain" },
      view && h("div", { class: "stage-area" }, h("div", { class: "toolbar", role: "toolbar", "aria-label": "View" }, toolbar.filter((part) => part)), view, below ?? ""),
      h("aside", { id: "panel", "aria-label": "Numbers", tabindex: "0" }, panel)));
  setTheme(0);
  return { setTheme: (name) => setTheme(THEMES.findIndex(([known]) => known === name)) };
}

/** A colour of the style sheet as the browser computes it now, light or dark. */
export function themeColor(name) {
  const probe = h("i", { style: `color: var(${name}); display: none` });
  document.body.append(probe);
  const color = getComputedStyle(probe).color;
  probe.remove();
  return color;
}

/** Instead of the page, when it cannot be shown. */
export function failure(error) {
  document.body.prepend(h("p", { class: "failure", role: "alert", id: "failure" }, `This page cannot be shown in this browser: ${error.message}`));
}

function save(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Saves what the canvas shows as a picture. */
export function savePicture(view, name) {
  view.drawNow();
  view.canvas.toBlob((blob) => save(blob, `${name}.png`));
}

/** Saves a text as a file. */
export function saveText(text, name, type) {
  save(new Blob([text], { type }), name);
}
