// Chapter 2: one line through the volume, searched slowly: which nodes of the kd-tree are left at once, which cells can
// hold the surface, and the cubic in each. The program gives the same hits after the same work.
Lesson.RaysChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "rays", title: "2 Rays", code: Lesson.RaysChapter.code, shownLayers: [1, 2, 3, 6, 7]});
    this.layers = {1: "box, slice", 2: "surface", 3: "line", 6: "hits", 7: "node, cell", 8: "cubic"};
    this.shownLayers = [1, 2, 3, 6, 7, 8];
    this.kinds = {
      line: {title: "a line", mark: "bar", role: "plain"},
      pruned: {title: "left at once", key: "l", mark: "cross", role: "refused"},
      kept: {title: "looked into", key: "i", mark: "square", role: "approximate"},
      none: {title: "a cell without a hit", key: "n", mark: "disc", role: "plain"},
      hit: {title: "a cell with hits", key: "h", mark: "star", role: "multi"},
    };
    run.rays.forEach((ray, r) => {
      this.list.push({kind: "line", ray: r});
      ray.nodes.forEach((node, n) => this.list.push({kind: node.pruned ? "pruned" : "kept", ray: r, node: n}));
      ray.cells.forEach((cell, c) => this.list.push({kind: cell.roots.length ? "hit" : "none", ray: r, cell: c}));
    });
  }

  ray(step) { return this.run.rays[this.list[step].ray]; }

  at({origin, direction}, t) { return Lesson.vectors.add(origin, Lesson.vectors.scale(t, direction)); }

  draw(picture, step) {
    const {kind, node, cell} = this.list[step];
    const ray = this.ray(step);
    const reach = this.run.camera.size;
    const ends = ray.cells.length ? [ray.cells[0].in - 2, ray.cells[ray.cells.length - 1].out + 2] : [-reach, reach];
    picture.line(ends.map((t) => this.at(ray, t)), "dualEdge", 3);
    if (kind === "line") return;
    if (node !== undefined) {
      const {low, high, pruned} = ray.nodes[node];
      picture.box(low, high, pruned ? "wrong" : "target", 7);
      return;
    }
    const its = ray.cells[cell];
    picture.box(its.cell, its.cell, "target", 7);
    for (const root of its.roots) picture.mark(this.at(ray, its.in + root * (its.out - its.in)), "star", "point", 6, 8);
    this.drawCubic(picture, its);
  }

  // The cubic over the cell, with its Bernstein polygon: in the lower left corner of the picture.
  drawCubic(picture, {cubic, roots}) {
    const [left, bottom, right] = this.run.camera.bounds();
    const [width, height] = [0.34 * (right - left), 0.13 * (right - left)];
    const largest = Math.max(...cubic.map(Math.abs), 1e-12);
    const place = (t, value) => [left + 0.03 * width + t * width, bottom + height * (1.25 + value / largest)];
    const scene = picture.scene.onLayer(8);
    scene.line([place(0, 0), place(1, 0)], "delaunay");
    scene.line(cubic.map((value, i) => place(i / 3, value)), "rim");
    const [a, b, c, d] = cubic;
    const value = (t) => {
      const s = 1 - t;
      return a * s * s * s + 3 * b * s * s * t + 3 * c * s * t * t + d * t * t * t;
    };
    scene.line(Array.from({length: 41}, (_, i) => place(i / 40, value(i / 40))), "mesh");
    for (const root of roots) scene.mark(place(root, 0), "star", "point", 7);
    scene.label(place(0.5, 1), "g along the line", "label", 3);
  }

  sentence(step) {
    const {kind, node, cell} = this.list[step];
    const ray = this.ray(step);
    if (kind === "line") {
      return `A line with ${
          Lesson.countText(ray.hits.length, "hit")}. The traversal begins at the root of the kd-tree.`;
    }
    if (node !== undefined) {
      const {low, high, pruned} = ray.nodes[node];
      const count = [0, 1, 2].reduce((product, axis) => product * (high[axis] - low[axis] + 1), 1);
      return `A node of ${Lesson.countText(count, "cell")}: ` +
          (pruned ? "its samples lie on one side of the isovalue, so it is left at once." :
                    "samples lie on both sides of the isovalue, so it is looked into.");
    }
    const its = ray.cells[cell];
    const [first, last] = [its.cubic[0], its.cubic[3]].map((value) => (value < 0 ? "below" : "above"));
    return `Cell ${its.cell.join(", ")}: the cubic begins ${first} and ends ${last}: ${
               Lesson.RaysChapter.allowed(its)}. ` +
        `It has ${Lesson.countText(its.roots.length, "hit")}.`;
  }

  next(step) {
    if (step + 1 >= this.list.length) return null;
    const {kind, node, cell} = this.list[step + 1];
    const words = node !== undefined ? "The next node: can it hold the isovalue?" :
        cell !== undefined           ? "The next cell: does the cubic change its sign?" :
                                       "Another line.";
    return {kind, sentence: words};
  }

  why(step) {
    const {node, cell} = this.list[step + 1] ?? {};
    if (node === undefined && cell === undefined) return {title: "Another line begins at the root.", rows: []};
    if (node !== undefined) {
      return {
        title: "A node keeps the smallest and the largest of its samples; it is left unless min < κ < max.",
        rows: []
      };
    }
    const its = this.ray(step + 1).cells[cell];
    const {cubic} = its;
    const row = (i) =>
        ({name: `Bernstein coefficient ${i}`, value: cubic[i], sign: "≥", limit: 0, holds: cubic[i] >= 0});
    return {title: "If all four lie on one side, so does the cubic.", rows: [0, 1, 2, 3].map(row)};
  }

  line(step) { return this.code.lineOf(this.list[step + 1]?.kind ?? "line"); }

  exercises() {
    const [ray] = this.run.rays;
    if (!ray) return [];
    const pruned = ray.nodes.filter((node) => node.pruned).length;
    const one = ray.cells.find((cell) => cell.cubic[0] < 0 !== cell.cubic[3] < 0);
    const list = [{
      question:
          `The first line comes to ${ray.nodes.length} nodes, and ${ray.cells.length} of them are cells that can ` +
          "hold the surface. How many nodes are left at once?",
      answer: () => pruned,
      because: () => "each of these needed two comparisons instead of all the cells below it.",
    }];
    if (one) {
      list.push({
        question: "The cubic of a cell begins and ends on different sides. What is the largest number of hits in it?",
        answer: () => 3,
        because: () => "an odd number, and a cubic has at most three roots.",
      });
    }
    return list;
  }
};

// How many hits the signs at the ends allow.
Lesson.RaysChapter.allowed = ({cubic}) => (cubic[0] < 0) === (cubic[3] < 0) ? "0 or 2 hits" : "1 or 3 hits";

Lesson.RaysChapter.code = (() => {
  const lines = [
    {text: "Intersect(O, κ, r)", file: "raycast/intersect.h", name: "intersect", kinds: ["line"]},
    {
      text: "V ← CollectVoxels: prune unless min < κ < max",
      file: "raycast/intersect.h",
      name: "collect_voxels",
      kinds: ["pruned", "kept"]
    },
    {
      text: "X ← FindIntersections: the roots of a cubic",
      file: "raycast/intersect.h",
      name: "find_intersections",
      kinds: ["none", "hit"]
    },
  ];
  return {title: "Figures 12 and 13", lines, lineOf: (kind) => lines.findIndex((line) => line.kinds.includes(kind))};
})();
