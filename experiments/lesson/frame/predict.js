// Predict mode: before the next step is shown, the reader names its kind. Nothing is typed in beforehand, the run
// itself is the answer; the first answer to a step counts, and a step that was taken without one counts no more.
Lesson.Predict = class {
  constructor() {
    this.isOn = false;
    this.right = 0;
    this.asked = 0;
    this.answered = new Map();  // step -> {guess, kind}
  }

  // Another run has other answers.
  restart() {
    this.right = 0;
    this.asked = 0;
    this.answered.clear();
  }

  toggle() { this.isOn = !this.isOn; }

  // Whether what follows this step is hidden.
  hides(step) { return this.isOn && !this.answered.has(step); }

  answer(step, guess, kind) {
    if (this.answered.has(step)) return null;
    this.answered.set(step, {guess, kind});
    this.asked += 1;
    if (guess === kind) this.right += 1;
    return guess === kind;
  }

  // A step taken without an answer: it is seen, and not asked.
  skip(step) {
    if (!this.answered.has(step)) this.answered.set(step, null);
  }

  scoreText() { return this.asked === 0 ? "no answer yet" : `${this.right} of ${this.asked} right`; }

  resultText(step, kinds) {
    const result = this.answered.get(step);
    if (!result) return null;
    const {guess, kind} = result;
    return guess === kind ? `Right: ${kinds[kind].title}.` :
                            `You said ${kinds[guess].title}; it is ${kinds[kind].title}.`;
  }
};
