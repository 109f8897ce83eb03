// What the hand does in the plane: it drags start points along the curve, and samples up and down.
Lesson.PlanePointer = class {
  constructor(laboratory) {
    this.laboratory = laboratory;
    this.held = null;
    this.waits = false;
  }

  // Whether something lies under the pointer that can be dragged.
  down(at, reach) {
    const {points, field} = this.laboratory;
    const distances = points.map((p) => Lesson.distance(p, at));
    const nearest = distances.indexOf(Math.min(...distances));
    if (nearest >= 0 && distances[nearest] < reach) {
      this.held = {point: nearest};
      return true;
    }
    const [i, j] = at.map(Math.round);
    const isInside = i > 0 && j > 0 && i < field.width - 1 && j < field.height - 1;
    if (!isInside || Lesson.distance([i, j], at) > Math.min(reach, 0.4)) return false;
    this.held = {sample: [i, j], from: at[1], value: field.values[j * field.width + i]};
    return true;
  }

  // A run takes longer than the pointer needs to move on, so that only the last place in a frame counts.
  move(at) {
    this.at = at;
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      this.apply();
    });
  }

  apply() {
    if (!this.held) return;
    if (this.held.sample) {
      const {sample: [i, j], from, value} = this.held;
      this.laboratory.setSample(i, j, value + (this.at[1] - from));
      return;
    }
    const point = Lesson.nearestOnCurve(this.laboratory.field, this.at, 4);
    if (point) this.laboratory.setPoint(this.held.point, point);
  }

  up() {
    this.apply();
    this.held = null;
  }
};

// The point of the level set nearest to p, as rays in many directions see it; null if none is within reach.
Lesson.nearestOnCurve = (field, p, reach) => {
  let nearest = null;
  for (let k = 0; k < 48; ++k) {
    const angle = (k * Math.PI) / 48;
    const to = [p[0] + Math.cos(angle), p[1] + Math.sin(angle)];
    for (const hit of field.hits(p, to, -reach, reach)) {
      if (!nearest || Math.abs(hit.t) < Math.abs(nearest.t)) nearest = hit;
    }
  }
  return nearest && nearest.point;
};
