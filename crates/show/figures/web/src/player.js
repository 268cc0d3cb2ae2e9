// Steps over time: the present one, and playing them one after the other.

const INTERVAL = 100;

export class Player {
  constructor(data) {
    Object.assign(this, { label: data.label, steps: data.steps, optional: data.optional, interval: data.interval || INTERVAL, repeats: data.repeats });
    /** The present step; -1 while the player is off. */
    this.position = data.optional ? -1 : 0;
    this.onchange = () => {};
  }

  get on() {
    return this.position >= 0;
  }

  get playing() {
    return this.timer !== undefined;
  }

  set(position) {
    this.position = Math.min(this.steps - 1, Math.max(this.optional ? -1 : 0, position));
    this.onchange();
  }

  /** From the present step to that of index `last`; from the first one if there is none left. */
  play(last) {
    this.stop();
    if (this.optional || this.position >= last) this.set(0);
    this.timer = setInterval(() => {
      if (this.position < last) this.set(this.position + 1);
      else if (this.repeats) this.set(0);
      else this.stop();
    }, this.interval);
    this.onchange();
  }

  stop() {
    clearInterval(this.timer);
    this.timer = undefined;
    this.onchange();
  }
}
