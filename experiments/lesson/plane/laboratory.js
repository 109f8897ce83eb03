// The chapter of the plane: a run that is computed anew whenever the reader changes the field, a point or a threshold.
Lesson.Laboratory = class {
  constructor(seed) {
    this.name = "plane";
    this.title = "2D lab";
    this.kinds = Lesson.planeStory.kinds;
    this.layers = Lesson.planePicture.layers;
    this.shownLayers = [1, 2, 4, 5, 6, 7, 8, 9];
    this.code = Lesson.planeCode;
    this.pointer = new Lesson.PlanePointer(this);
    this.seed = seed;
    this.options = {...Lesson.Run.defaults};
    this.showsValues = false;
    this.context = {rerun() {}, redraw() {}};
    this.chooseField("ring");
  }

  open(context) { this.context = context; }

  chooseField(name) {
    this.fieldName = name;
    this.field = Lesson.fields.named(name, this.seed);
    this.drawPoints();
  }

  // Start points of this field and seed.
  drawPoints() {
    this.points = Lesson.startPoints(this.field, new Lesson.Random(this.seed), this.options);
    this.compute();
  }

  compute() {
    const begin = performance.now();
    const run = new Lesson.Run(this.field, this.points, this.options);
    this.milliseconds = performance.now() - begin;
    this.failure = run.failure ?? null;
    // Where nothing can be run, as without a curve, the last run stays in sight.
    if (!run.failure) this.run = run;
    this.exerciseBox?.replaceChildren(...this.exercises().map(Lesson.exercise));
    this.context.rerun();
  }

  setOption(name, value) {
    this.options[name] = value;
    if (name === "start" || name === "seeding")
      this.drawPoints();
    else
      this.compute();
  }

  setSeed(seed) {
    this.seed = seed;
    this.chooseField(this.fieldName);
  }

  setSample(i, j, value) {
    this.field = this.field.withSample(i, j, value);
    // Points stay on the curve, on the place nearest to where they were, or leave where it has gone.
    this.points = this.points.map((p) => Lesson.nearestOnCurve(this.field, p, 3)).filter(Boolean);
    if (this.points.length < 3)
      this.points = Lesson.startPoints(this.field, new Lesson.Random(this.seed), this.options);
    this.compute();
  }

  setPoint(k, point) {
    this.points = this.points.map((p, i) => (i === k ? point : p));
    this.compute();
  }

  frame(step) { return this.run.frames[Math.min(step, this.run.frames.length - 1)]; }

  steps() { return this.run.frames; }

  scene(step, {preview}) {
    return Lesson.planePicture.scene(this.run, this.frame(step), {preview, showsValues: this.showsValues});
  }

  sentence(step) {
    const frame = this.frame(step);
    return this.failure ? `No run: ${this.failure}.` : Lesson.planeStory.happened(this.run, frame);
  }

  // The certificate of the mesh so far: when does it become right, and does it stay so?
  status(step) {
    const frame = this.frame(step);
    const {isRight, complaints, pieces, loops} = this.run.certificate(frame);
    if (frame.kind === "end") return "";  // the sentence is the verdict
    if (!isRight) return `Mesh so far: ${complaints.join("; ")}.`;
    return `Mesh so far ✓: ${Lesson.countText(pieces, "piece")} for ${Lesson.countText(loops, "loop")}.`;
  }

  next(step) {
    const {next} = this.frame(step);
    return next && {kind: next.kind, sentence: Lesson.planeStory.coming(next)};
  }

  why(step) { return Lesson.planeStory.why(this.run, this.frame(step)); }

  line(step) { return this.code.lineOf(this.frame(step).next?.kind ?? "end"); }

  exercises() { return Lesson.planeExercises(this.run); }

  panel() { return Lesson.planePanel(this); }
};

Lesson.preparations =
    [...(Lesson.preparations ?? []), () => Lesson.chapters.push(new Lesson.Laboratory(Lesson.data.seed))];
