// What all chapters about space have: steps that are events of a run, the picture turned by hand, layers, words. A
// chapter says which events it shows (`steps`) and what it draws (`draw`).
Lesson.SpaceChapter = class {
  constructor(run, {name, title, code, shownLayers = [1, 2, 5]}) {
    Object.assign(this, {run, name, title, code, shownLayers});
    this.kinds = Lesson.spaceStory.kinds;
    this.layers = Lesson.SpacePicture.layers;
    this.list = [];  // {kind, event}: the state after that event
    this.sliceAt = null;
    this.context = {redraw() {}, rerun() {}};
    this.pointer = this.run.camera.dragging(() => this.context.redraw());
  }

  // The kinds of one stage: refusals of both have the same mark and the same key.
  keepKinds(names) { this.kinds = Object.fromEntries(names.map((name) => [name, Lesson.spaceStory.kinds[name]])); }

  open(context) { this.context = context; }

  steps() { return this.list; }

  event(step) { return this.run.events[this.list[step].event]; }

  // The event that comes after a step, or null.
  nextEvent(step) { return step + 1 < this.list.length ? this.event(step + 1) : null; }

  scene(step, {preview, layers}) {
    const picture = new Lesson.SpacePicture(this.run, this.run.camera, layers);
    picture.context(this.sliceAt);
    this.draw(picture, step, preview);
    return picture.scene;
  }

  sentence(step) {
    const after = this.list.length - 1 === step && this.run.leftOut && this.event(step).e !== "end" ?
        ` ${this.run.leftOut} more steps are not in this page.` :
        "";
    return Lesson.spaceStory.happened(this.event(step)) + this.extra(step) + after;
  }

  // What a chapter adds to the sentence of a step.
  extra() { return ""; }

  next(step) {
    const event = this.nextEvent(step);
    return event && {kind: this.list[step + 1].kind, sentence: Lesson.spaceStory.coming(event)};
  }

  why(step) { return Lesson.spaceStory.why(this.nextEvent(step), this.run.limits); }

  line(step) {
    const event = this.nextEvent(step);
    return event ? this.code.lineOf(Lesson.spaceStory.kindOf(event)) : -1;
  }

  panel() { return Lesson.element("div", {}, ...this.exercises().map(Lesson.exercise), this.viewPanel()); }

  exercises() { return []; }

  // For those who cannot drag, and the slice.
  viewPanel() {
    const {element} = Lesson;
    const turn = (text, label, a, b) => element(
        "button", {
          "aria-label": label,
          title: label,
          onclick: () => {
            this.run.camera.rotate(a, b);
            this.context.redraw();
          }
        },
        text);
    const height = this.run.volume.dims[2];
    const slice = element("input", {
      type: "range",
      min: -1,
      max: height - 1,
      value: this.sliceAt ?? -1,
      "aria-label": "slice plane",
      oninput: (event) => {
        this.sliceAt = Number(event.target.value) < 0 ? null : Number(event.target.value);
        this.context.redraw();
      }
    });
    return element(
        "div", {}, element("h2", {}, "View"), turn("←", "turn left", -0.2, 0), turn("→", "turn right", 0.2, 0),
        turn("↑", "tilt up", 0, 0.2), turn("↓", "tilt down", 0, -0.2),
        this.run.volume.samples.length ?
            element("label", {class: "setting"}, element("span", {}, "slice with the exact curve"), slice) :
            null);
  }
};
