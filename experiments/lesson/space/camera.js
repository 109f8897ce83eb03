// The box around points, [low, high].
Lesson.boxOf = (points) => [Math.min, Math.max].map(
    (pick) => [0, 1, 2].map((axis) => points.reduce((best, p) => pick(best, p[axis]), points[0][axis])));

// Where the reader stands: turns space into the plane, and tells what lies in front of what. The picture is not
// foreshortened, so that parallel edges stay parallel.
Lesson.Camera = class {
  // Looks at the middle of a box, [low, high].
  constructor([low, high]) {
    const {vectors} = Lesson;
    this.middle = vectors.mean([low, high]);
    this.size = vectors.distance(low, high);
    this.reset();
  }

  reset() {
    this.turn = 0.6;
    this.tilt = 0.75;
    this.update();
  }

  update() {
    const [s, c, u, w] = [Math.sin(this.turn), Math.cos(this.turn), Math.sin(this.tilt), Math.cos(this.tilt)];
    this.right = [c, s, 0];
    this.up = [-s * u, c * u, w];
    this.towards = [s * w, -c * w, u];  // from the middle to the reader
  }

  rotate(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.max(-1.5, Math.min(1.5, this.tilt + tilt));
    this.update();
  }

  // A pointer whose dragging turns the picture, half a turn across its width; `redraw` is called after each move.
  dragging(redraw) {
    let at = null;
    return {
      down: (p) => {
        at = p;
        return true;
      },
      move: (p) => {
        const per = Math.PI / this.size;
        this.rotate((at[0] - p[0]) * per, (at[1] - p[1]) * per);
        at = p;
        redraw();
      },
      up: () => {},
    };
  }

  toPlane(p) {
    const d = Lesson.vectors.sub(p, this.middle);
    return [Lesson.vectors.dot(d, this.right), Lesson.vectors.dot(d, this.up)];
  }

  // The larger, the nearer to the reader.
  nearness(p) { return Lesson.vectors.dot(Lesson.vectors.sub(p, this.middle), this.towards); }

  bounds() {
    const half = 0.5 * this.size;
    return [-half, -half, half, half];
  }
};
