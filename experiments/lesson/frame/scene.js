// A picture as data: what is drawn where, in the coordinates of the plane, before anybody knows of a screen. State goes
// in, a scene comes out, and a painter puts it on a canvas or into an SVG file.
Lesson.Scene = class {
  // `bounds` is [left, bottom, right, top]; y points upwards.
  constructor(bounds) {
    this.bounds = bounds;
    this.items = [];
    this.labels = [];
    this.layer = 0;
  }

  // What follows belongs to this layer (1 to 9, 0 is always shown).
  onLayer(layer) {
    this.layer = layer;
    return this;
  }

  line(points, role) { this.items.push({kind: "path", points, closed: false, role, layer: this.layer}); }

  polygon(points, role) { this.items.push({kind: "path", points, closed: true, role, layer: this.layer}); }

  // The radius is a length of the plane.
  circle(center, radius, role) { this.items.push({kind: "circle", center, radius, role, layer: this.layer}); }

  // Many items at once (sheet.js).
  sheet(name, items) { this.items.push(new Lesson.Sheet(name, items, this.layer)); }

  // A mark keeps its size, given in pixels, at every scale.
  mark(point, shape, role, size = 5) { this.items.push({kind: "mark", point, shape, role, size, layer: this.layer}); }

  // Where labels would overlap, those of less weight move or are left out.
  label(point, text, role = "label", weight = 1) { this.labels.push({point, text, role, weight, layer: this.layer}); }
};

// Where the plane lies on the screen.
Lesson.View = class {
  constructor(bounds, width, height, margin = 14) {
    const [left, bottom, right, top] = bounds;
    this.width = width;
    this.height = height;
    this.scale = Math.min((width - 2 * margin) / (right - left), (height - 2 * margin) / (top - bottom));
    this.x = width / 2 - (this.scale * (left + right)) / 2;
    this.y = height / 2 + (this.scale * (bottom + top)) / 2;
  }

  // Enlarges about a point of the screen.
  zoom(factor, x, y) {
    this.x = x + (this.x - x) * factor;
    this.y = y + (this.y - y) * factor;
    this.scale *= factor;
  }

  toScreen([x, y]) { return [this.x + this.scale * x, this.y - this.scale * y]; }

  toPlane([x, y]) { return [(x - this.x) / this.scale, (this.y - y) / this.scale]; }
};

// Marks as outlines: {points, closed} for each stroke. Kinds differ in shape as well as in colour.
Lesson.markStrokes = (shape, x, y, size) => {
  const corners = (count, turn, radii = [1]) => {
    const points = [];
    for (let i = 0; i < count; ++i) {
      const angle = turn + (2 * Math.PI * i) / count;
      const radius = size * radii[i % radii.length];
      points.push([x + radius * Math.sin(angle), y - radius * Math.cos(angle)]);
    }
    return [{points, closed: true}];
  };
  const across = (dx, dy) => ({points: [[x - dx, y - dy], [x + dx, y + dy]], closed: false});
  switch (shape) {
    case "disc":
      return corners(size < 3 ? 8 : 16, 0);
    case "square":
      return corners(4, Math.PI / 4);
    case "diamond":
      return corners(4, 0);
    case "triangle":
      return corners(3, 0);
    case "down":
      return corners(3, Math.PI);
    case "pentagon":
      return corners(5, 0);
    case "star":
      return corners(10, 0, [1.3, 0.55]);
    case "cross":
      return [across(size * 0.75, size * 0.75), across(size * 0.75, -size * 0.75)];
    case "plus":
      return [across(size, 0), across(0, size)];
    case "dash":
      return [across(size, 0)];
    case "bar":
      return [across(0, size)];
    default:
      throw new Error(`no mark "${shape}"`);
  }
};

// Draws a scene with a painter: one with path(), circle() and text(). Layers that are off are left out. Returns the
// boxes of the labels.
Lesson.paint = (scene, view, painter, {layers, dark, fontSize = 13}) => {
  const styles = new Map();
  const styleOf = (role) => {
    if (!styles.has(role)) styles.set(role, Lesson.theme.style(role, dark));
    return styles.get(role);
  };
  const isShown = (item) => item.layer === 0 || !layers || layers.has(item.layer);
  const paintItem = (to, item) => {
    const style = styleOf(item.role);
    if (item.kind === "path") {
      to.path(item.points.map((p) => view.toScreen(p)), item.closed, style);
    } else if (item.kind === "circle") {
      to.circle(...view.toScreen(item.center), item.radius * view.scale, style);
    } else {
      const strokes = Lesson.markStrokes(item.shape, ...view.toScreen(item.point), item.size);
      for (const stroke of strokes) to.path(stroke.points, stroke.closed, style);
    }
  };
  for (const item of scene.items) {
    if (!isShown(item)) continue;
    if (item.kind !== "sheet")
      paintItem(painter, item);
    else if (painter.sheets)
      painter.sheet(item, view, dark, {paintItem, styleOf});
    else
      for (const part of item.items) paintItem(painter, part);
  }
  const placed = Lesson.placeLabels(scene.labels.filter(isShown), view, fontSize);
  const halo = Lesson.theme.colour("paper", dark);
  for (const label of placed) {
    const style = Lesson.theme.style(label.role, dark);
    painter.text(label.x, label.y, label.text, {size: fontSize, colour: style.text, halo});
  }
  return placed;
};
