// Numbers for people. What is shown of an enclosure still encloses: ends are rounded outwards.

const MINUS = "\u2212";

/** The unit in the last of `digits` significant digits of `x`. */
const unitOf = (x, digits) => 10 ** (Math.floor(Math.log10(Math.abs(x))) - digits + 1);

function rounded(x, digits, beyond, step) {
  if (x === 0 || !Number.isFinite(x)) return x;
  let shown = Number(x.toPrecision(digits));
  for (let i = 1; beyond(shown, x) && i < 4; i++) {
    shown = Number((Number(x.toPrecision(digits)) + i * step * unitOf(x, digits)).toPrecision(digits));
  }
  return beyond(shown, x) ? x : shown;
}

/** The greatest number of that many digits, about, that is not above `x`. */
export const down = (x, digits) => rounded(x, digits, (shown, x) => shown > x, -1);
/** The least number of that many digits, about, that is not below `x`. */
export const up = (x, digits) => rounded(x, digits, (shown, x) => shown < x, 1);

/** A number in the digits it has, with a power of ten where it is very small or large. */
export function plain(x) {
  if (x === 0) return "0";
  const size = Math.abs(x);
  let text;
  if (size >= 1e-4 && size < 1e7) {
    text = String(size);
    if (size >= 1e4) {
      const [whole, part] = text.split(".");
      text = whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") + (part ? "." + part : "");
    }
  } else {
    const [digits, power] = size.toExponential().split("e");
    text = `${digits}\u00b710${superscript(Number(power))}`;
  }
  return (x < 0 ? MINUS : "") + text;
}

const superscript = (n) => String(n).replace(/./g, (c) => ({ "-": "\u207b" })[c] ?? "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]);

/** A number in at most that many digits. */
export const short = (x, digits = 4) => plain(Number(x.toPrecision(digits)));

/** Digits that show the width of an enclosure in two digits, no fewer than `least` and no more than `most`. */
function digitsFor([lower, upper], least, most) {
  const width = upper - lower;
  if (!(width > 0)) return most;
  const size = Math.max(Math.abs(lower), Math.abs(upper));
  return Math.min(most, Math.max(least, Math.ceil(Math.log10(size / width)) + 2));
}

/** The ends of an enclosure, rounded outwards. */
export function ends([lower, upper], least = 4, most = 9) {
  const digits = digitsFor([lower, upper], least, most);
  return [down(lower, digits), up(upper, digits)];
}

/** `[lower, upper]`, rounded outwards. */
export function enclosure(interval, least = 4, most = 9) {
  const [lower, upper] = ends(interval, least, most);
  return `[${plain(lower)}, ${plain(upper)}]`;
}

/** All digits of the ends. */
export const exactly = ([lower, upper]) => `[${lower}, ${upper}]`;

/** An enclosure of a fraction as per cent, rounded outwards. */
export function percent([lower, upper]) {
  // Multiplying by 100 rounds: one step outwards more than makes up for it.
  const low = Math.max(0, down(lower * 100 * (1 - 2 ** -51), 3));
  const high = Math.min(100, up(upper * 100 * (1 + 2 ** -51), 3));
  return low === high ? `${plain(low)}\u202f%` : `${plain(low)} to ${plain(high)}\u202f%`;
}

/** Numbers that are easy to read, about `count` of them, from `low` to `high`. */
export function ticks(low, high, count) {
  const raw = (high - low) / count;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((m) => m * power >= raw * 0.999) ?? 10);
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-12) + step * 1e-9; i++) {
    all.push(Number((i * step).toPrecision(12)));
  }
  return all;
}

export const count = (n) => plain(n);
export const plural = (n, one, many = one + "s") => `${count(n)} ${n === 1 ? one : many}`;

/** Text with numbers in it. */
export const textOf = (parts) => parts.map((part) => {
  if (typeof part === "string") return part;
  if (part.enclosure) return enclosure(part.enclosure);
  if (part.count !== undefined) return part.of ? plural(part.count, part.of) : count(part.count);
  return short(part.number, part.digits);
}).join("");
