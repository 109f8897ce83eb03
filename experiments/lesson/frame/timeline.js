// The timeline: one tick an event, whose colour and shape both tell its kind. It is a slider for the keyboard and for
// screen readers, and can be scrubbed.
Lesson.Timeline = class {
  // `goTo(step)` is called while the reader scrubs.
  constructor(goTo) {
    this.goTo = goTo;
    this.canvas = Lesson.element("canvas", {
      class: "timeline",
      role: "slider",
      tabindex: 0,
      "aria-label": "step",
      "aria-valuemin": 0,
    });
    this.ticksCanvas = Lesson.element("canvas", {});
    this.isHeld = false;
    this.canvas.addEventListener("pointerdown", (event) => {
      this.isHeld = true;
      this.canvas.setPointerCapture(event.pointerId);
      this.scrub(event);
    });
    this.canvas.addEventListener("pointermove", (event) => this.isHeld && this.scrub(event));
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => (this.isHeld = false));
  }

  scrub(event) {
    const box = this.canvas.getBoundingClientRect();
    this.goTo(Math.round(this.stepAt(event.clientX - box.left, box.width)));
  }

  stepAt(x, width) {
    const last = Math.max(this.last, 1);
    return Math.min(this.last, Math.max(0, ((x - 12) / (width - 24)) * last));
  }

  // Ticks from `shown` on are drawn as mere points where the reader is to predict them.
  draw(steps, kinds, step, text, hidesFuture) {
    this.last = steps.length - 1;
    this.canvas.setAttribute("aria-valuemax", this.last);
    this.canvas.setAttribute("aria-valuenow", step);
    this.canvas.setAttribute("aria-valuetext", text);
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (width === 0) return;
    const context = Lesson.sizedContext(this.canvas, width, height);
    const dark = Lesson.theme.isDark();
    const look = [steps.length, hidesFuture ? step : "", width, height, dark, window.devicePixelRatio].join();
    // They stay as they are from step to step.
    if (look !== this.look || steps !== this.steps) {
      const scene = this.ticks(steps, kinds, step, hidesFuture, width, height);
      this.paint(scene, Lesson.sizedContext(this.ticksCanvas, width, height), width, height, dark);
      Object.assign(this, {look, steps});
    }
    context.drawImage(this.ticksCanvas, 0, 0, width, height);
    const cursor = new Lesson.Scene([0, 0, width, height]);
    const x = this.xOf(step, steps, width);
    cursor.line([[x, 3], [x, height - 3]], "cursor");
    this.paint(cursor, context, width, height, dark);
  }

  paint(scene, context, width, height, dark) {
    const view = {width, height, scale: 1, toScreen: (p) => p};
    Lesson.paint(scene, view, new Lesson.CanvasPainter(context), {layers: null, dark});
  }

  xOf(i, steps, width) { return 12 + ((width - 24) * i) / Math.max(steps.length - 1, 1); }

  ticks(steps, kinds, step, hidesFuture, width, height) {
    const scene = new Lesson.Scene([0, 0, width, height]);
    const middle = height / 2;
    scene.line([[12, middle], [width - 12, middle]], "grid");
    // A long run has more ticks than pixels to tell them apart by, so marks shrink, but not out of sight.
    const size = Math.max(2.5, Math.min(7, (width - 24) / steps.length / 1.6));
    const drawn = new Set();
    steps.forEach((event, i) => {
      const x = this.xOf(i, steps, width);
      // Of equal ticks at one place the first is enough.
      const place = `${Math.round(x)} ${hidesFuture && i > step ? "" : event.kind}`;
      if (drawn.has(place)) return;
      drawn.add(place);
      const isHidden = hidesFuture && i > step;
      const kind = kinds[event.kind];
      scene.mark(
          [x, middle + (isHidden ? 0 : kind.rise ?? 0)], isHidden ? "bar" : kind.mark, isHidden ? "grid" : kind.role,
          isHidden ? 3 : size);
    });
    return scene;
  }
};

// The context of a canvas whose pixels are those of the screen, cleared.
Lesson.sizedContext = (canvas, width, height) => {
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
};
