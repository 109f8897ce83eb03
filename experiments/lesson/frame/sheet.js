// Many things of a picture that stay from step to step, such as the triangles of a mesh: `items` in the order in which
// they are painted, each the same object in every picture that has it. A screen keeps what it has painted of them.
Lesson.Sheet = class {
  constructor(name, items, layer) { Object.assign(this, {kind: "sheet", name, items, layer}); }

  // Items in the order of `compare`, of which some go and others come; those that stay are not sorted again.
  static merged(items, isGone, come, compare) {
    const added = come.sort(compare);
    const all = [];
    let next = 0;
    for (const item of items) {
      if (isGone(item)) continue;
      while (next < added.length && compare(added[next], item) < 0) all.push(added[next++]);
      all.push(item);
    }
    while (next < added.length) all.push(added[next++]);
    return all;
  }
};

// What a screen has painted of a sheet. Where a few items come or go, only the rectangle around them is painted anew;
// where that is too much for a frame, all is, as many in a frame as a frame has time for.
Lesson.PaintedSheet = (() => {
  const kMostInFrame = 2500;
  const kMostChanged = 1000;
  const kMargin = 3;  // pixels by which lines reach beyond their points, beside their width

  // The box of an item in the plane, without the width of its lines: [left, bottom, right, top].
  const boxOf = (item) => (item.box ??= findBox(item.points ?? [item.point]));

  const findBox = (points) => {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of points) {
      if (x < box[0]) box[0] = x;
      if (y < box[1]) box[1] = y;
      if (x > box[2]) box[2] = x;
      if (y > box[3]) box[3] = y;
    }
    return box;
  };

  return class {
    constructor() {
      this.canvas = document.createElement("canvas");
      this.items = [];
      this.done = 0;  // how many of them are painted
    }

    isWhole() { return this.done === this.items.length; }

    // Paints what is not painted yet, with `paintItem(painter, item)`.
    show({items}, view, ratio, dark, tools) {
      const look = [view.x, view.y, view.scale, view.width, view.height, ratio, dark].join();
      Object.assign(this, {view, ratio, ...tools});
      const changed = look === this.look && items !== this.items ? this.changes(items) : [];
      const isOther = look !== this.look || changed.length > kMostChanged;
      this.done = isOther ? 0 : this.doneAmong(items);
      this.items = items;
      if (isOther)
        this.begin(look);
      else if (changed.length)
        this.repaint(this.rectangleAround(changed));
      if (!this.isWhole()) this.paintMore();
    }

    // How many of other items come no later than the last one that is painted.
    doneAmong(items) {
      if (this.isWhole() || items === this.items) return items === this.items ? this.done : items.length;
      const painted = new Set(this.items.slice(0, this.done));
      let done = items.length;
      while (done > 0 && !painted.has(items[done - 1])) --done;
      return done;
    }

    begin(look) {
      this.look = look;
      this.done = 0;
      Lesson.sizedContext(this.canvas, this.view.width, this.view.height);
    }

    paintMore() {
      const painter = new Lesson.CanvasPainter(this.canvas.getContext("2d"));
      const end = Math.min(this.items.length, this.done + kMostInFrame);
      for (; this.done < end; ++this.done) this.paintItem(painter, this.items[this.done]);
    }

    // Items that have come or gone.
    changes(items) {
      const gone = new Set(this.items);
      return [...items.filter((item) => !gone.delete(item)), ...gone];
    }

    // Of an item, in pixels of the canvas: [left, top, right, bottom].
    onScreen(item) {
      const {ratio, view: {x, y, scale}} = this;
      const [left, bottom, right, top] = boxOf(item);
      const wide = kMargin + this.styleOf(item.role).width + (item.size ? 1.4 * item.size : 0);
      return [
        (x + scale * left - wide) * ratio, (y - scale * top - wide) * ratio, (x + scale * right + wide) * ratio,
        (y - scale * bottom + wide) * ratio
      ];
    }

    // In whole pixels, so that what is painted within it meets what is around it.
    rectangleAround(items) {
      const {width, height} = this.canvas;
      const found = [width, height, 0, 0];
      for (const item of items) {
        const box = this.onScreen(item);
        for (let i = 0; i < 2; ++i) found[i] = Math.max(0, Math.min(found[i], Math.floor(box[i])));
        for (let i = 2; i < 4; ++i) found[i] = Math.max(found[i], Math.ceil(box[i]));
      }
      return [found[0], found[1], Math.min(width, found[2]), Math.min(height, found[3])];
    }

    repaint([left, top, right, bottom]) {
      if (left >= right || top >= bottom) return;
      const within = this.items.slice(0, this.done).filter((item) => {
        const box = this.onScreen(item);
        return box[0] < right && box[2] > left && box[1] < bottom && box[3] > top;
      });
      if (within.length > kMostInFrame) return this.begin(this.look);
      const {ratio} = this;
      const context = this.canvas.getContext("2d");
      const painter = new Lesson.CanvasPainter(context);
      context.save();
      context.beginPath();
      context.rect(left / ratio, top / ratio, (right - left) / ratio, (bottom - top) / ratio);
      context.clip();
      context.clearRect(left / ratio, top / ratio, (right - left) / ratio, (bottom - top) / ratio);
      for (const item of within) this.paintItem(painter, item);
      context.restore();
    }
  };
})();

// The sheets that a screen has painted, by their names.
Lesson.PaintedSheets = class {
  constructor() {
    this.all = new Map();
    this.shown = new Set();  // in this picture
  }

  // Into the picture of `context`, which has as many pixels as the sheet.
  show(context, sheet, view, dark, tools) {
    if (!this.all.has(sheet.name)) this.all.set(sheet.name, new Lesson.PaintedSheet());
    const painted = this.all.get(sheet.name);
    this.shown.add(painted);
    painted.show(sheet, view, window.devicePixelRatio || 1, dark, tools);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(painted.canvas, 0, 0);
    context.restore();
  }

  begin() { this.shown.clear(); }

  isWhole() { return [...this.shown].every((painted) => painted.isWhole()); }
};
