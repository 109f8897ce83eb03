// Plays a chapter that has steps: which step is shown, what is hidden, and what each command does. It knows of no
// screen; the stage and the cards draw what it says.
Lesson.Player = class {
  // `changed()` is called whenever something else is to be seen.
  constructor(chapter, changed) {
    this.chapter = chapter;
    this.changed = changed;
    this.step = 0;
    this.predict = new Lesson.Predict();
    this.layers = new Set(chapter.shownLayers ?? Object.keys(chapter.layers).map(Number));
    this.timer = null;
  }

  last() { return this.chapter.steps().length - 1; }

  // Whether predict mode asks for what follows a step. A kind without a key is no answer, so before it nothing is
  // asked.
  asks(step) { return step < this.last() && Boolean(this.chapter.kinds[this.chapter.steps()[step + 1].kind].key); }

  // The nearest step whose question is open, from here on and then from the start; -1: none is.
  openQuestion() {
    const count = this.last() + 1;
    const steps = Array.from({length: count}, (_, i) => (this.step + i) % count);
    return steps.find((step) => this.asks(step) && !this.predict.answered.has(step)) ?? -1;
  }

  hidesNext() { return this.predict.hides(this.step) && this.asks(this.step); }

  goTo(step) {
    const to = Math.max(0, Math.min(step, this.last()));
    // Leaving a step forwards shows what was asked there.
    for (let i = this.step; this.predict.isOn && i < to; ++i) this.predict.skip(i);
    this.step = to;
    this.changed();
  }

  // The nearest step in a direction whose kind is, or is not, that of the step after this one.
  toKind(direction, isSame) {
    const steps = this.chapter.steps();
    const kind = steps[this.step].kind;
    let i = this.step + direction;
    while (i > 0 && i < this.last() && (steps[i].kind === kind) !== isSame) i += direction;
    this.goTo(i);
  }

  // The next step of a kind; after the last one the first.
  toNext(kind) {
    const isOne = ({kind: its}) => its === kind;
    const steps = this.chapter.steps();
    const after = steps.slice(this.step + 1).findIndex(isOne);
    this.goTo(after < 0 ? steps.findIndex(isOne) : this.step + 1 + after);
  }

  answer(guess) {
    if (!this.hidesNext()) return;
    this.predict.answer(this.step, guess, this.chapter.steps()[this.step + 1].kind);
    this.changed();
  }

  pause() {
    if (this.timer !== null) clearInterval(this.timer);
    this.timer = null;
  }

  // Nothing moves unless the reader asks for it, and where less motion is wanted nothing moves at all.
  play() {
    if (window.matchMedia("(prefers-reduced-motion: reduce)").matches) return this.toKind(1, false);
    if (this.timer !== null) {
      this.pause();
      return this.changed();
    }
    if (this.step === this.last()) this.step = 0;
    this.timer = setInterval(() => {
      if (this.step >= this.last() || this.hidesNext())
        this.pause();
      else
        this.step += 1;
      this.changed();
    }, 700);
    return this.changed();
  }

  toggleLayer(layer) {
    if (!(layer in this.chapter.layers)) return;
    if (!this.layers.delete(layer)) this.layers.add(layer);
    this.changed();
  }

  // Whether the command was one of a player.
  command(name) {
    if (name !== "play") this.pause();
    switch (name) {
      case "next":
        this.goTo(this.step + 1);
        return true;
      case "back":
        this.goTo(this.step - 1);
        return true;
      case "nextOfKind":
        this.toKind(1, true);
        return true;
      case "backOfKind":
        this.toKind(-1, true);
        return true;
      case "first":
        this.goTo(0);
        return true;
      case "last":
        this.goTo(this.last());
        return true;
      case "play":
        this.play();
        return true;
      case "predict":
        this.predict.toggle();
        this.changed();
        return true;
      default:
        return false;
    }
  }

  // The run is another one: its steps have other answers. The reader stays at the step.
  rerun() {
    this.pause();
    this.predict.restart();
    this.step = Math.min(this.step, this.last());
    this.changed();
  }
};
