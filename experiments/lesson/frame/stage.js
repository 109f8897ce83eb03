// The picture on the screen: its canvas, enlarging, and the pointer, which drags what the chapter lets be dragged and
// else moves the picture.
Lesson.Stage = class {
  constructor() {
    this.canvas = Lesson.element("canvas", {class: "stage", role: "img", "aria-label": "picture"});
    this.player = null;
    this.view = null;
    this.hold = null;
    this.sheets = new Lesson.PaintedSheets();
    this.isWaiting = false;  // for a frame, to go on
    this.canvas.addEventListener("pointerdown", (event) => this.down(event));
    this.canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => this.up());
    this.canvas.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
  }

  show(player) {
    if (this.player !== player) this.view = null;
    this.player = player;
    this.draw();
  }

  scene() {
    const {chapter, step} = this.player;
    return chapter.scene(step, {preview: !this.player.hidesNext(), layers: this.player.layers});
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (!this.player || width === 0) return;
    const scene = this.scene();
    const isSame = this.view && this.view.width === width && this.view.height === height &&
        this.bounds.every((bound, i) => bound === scene.bounds[i]);
    if (!isSame) this.view = new Lesson.View(scene.bounds, width, height);
    this.bounds = scene.bounds;
    this.sheets.begin();
    const painter = new Lesson.CanvasPainter(Lesson.sizedContext(this.canvas, width, height), this.sheets);
    Lesson.paint(scene, this.view, painter, {layers: this.player.layers, dark: Lesson.theme.isDark()});
    this.canvas.setAttribute("aria-label", this.player.chapter.sentence(this.player.step));
    this.drawRest();
  }

  // A picture that is too much for one frame is finished in the next ones.
  drawRest() {
    if (this.sheets.isWhole() || this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  // Null: back to the whole.
  zoom(factor, x = this.view.width / 2, y = this.view.height / 2) {
    if (factor === null)
      this.view = null;
    else
      this.view.zoom(factor, x, y);
    this.draw();
  }

  position(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  down(event) {
    const at = this.position(event);
    const {chapter, step} = this.player;
    // A finger is less exact than a mouse.
    const reach = (event.pointerType === "mouse" ? 10 : 22) / this.view.scale;
    const isTaken = chapter.pointer?.down(this.view.toPlane(at), reach, step) ?? false;
    this.hold = {isTaken, at};
    this.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    if (!this.hold) return;
    const at = this.position(event);
    if (this.hold.isTaken) {
      this.player.chapter.pointer.move(this.view.toPlane(at));
    } else {
      this.view.x += at[0] - this.hold.at[0];
      this.view.y += at[1] - this.hold.at[1];
      this.hold.at = at;
      this.draw();
    }
  }

  up() {
    if (this.hold?.isTaken) this.player.chapter.pointer.up();
    this.hold = null;
  }

  wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY / 500), ...this.position(event));
  }
};
