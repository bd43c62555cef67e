// Whether drawing keeps up, and how sharp the picture may be so that the mouth keeps moving.

const COARSEST = 0.3; // of the picture's width and height
const STEP = 0.7;
const SLOW = 34; // milliseconds a frame: less than 30 a second
const QUICK = 20;
const GAP = 1500; // a longer wait is no slow frame, but none
const WINDOW = 8;
const SHORT_OF_TIME = 400; // milliseconds after which fewer frames have to do
const MOST_PATIENT = 64;

/** Judges the middle of eight frames in a row: coarser at once when they are slow, sharper again after some quick rows. */
export class Pace {
  private last = 0;
  private waits: number[] = [];
  private quick = 0;
  private patience = 4;

  constructor(public sharpness: number) {}

  /** Whether the sharpness has changed with the frame drawn at `now` milliseconds. */
  frame(now: number): boolean {
    const wait = now - this.last;
    this.last = now;
    if (wait > GAP) this.waits = [];
    else this.waits.push(wait);
    const passed = this.waits.reduce((sum, each) => sum + each, 0);
    if (this.waits.length < (passed > SHORT_OF_TIME ? 3 : WINDOW)) return false;
    const middle = this.waits.sort((a, b) => a - b)[this.waits.length >> 1];
    this.waits = [];
    const before = this.sharpness;
    if (middle > SLOW) {
      if (this.sharpness < 1) this.patience = Math.min(2 * this.patience, MOST_PATIENT); // sharper was too much: try it less often
      this.sharpness = Math.max(this.sharpness * STEP, COARSEST);
      this.quick = 0;
    } else if (middle < QUICK && this.sharpness < 1 && ++this.quick >= this.patience) {
      this.sharpness = Math.min(this.sharpness / STEP, 1);
      this.quick = 0;
    }
    return this.sharpness !== before;
  }
}
