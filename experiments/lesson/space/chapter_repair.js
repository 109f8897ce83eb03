// Chapter 10: what the certificate demands, and repair, which the paper does not have. The mesh of stage 1 is compared
// with the exact topology, component by component; where they differ, voxel cells are sampled anew, round by round.
Lesson.RepairChapter = class extends Lesson.SpaceChapter {
  constructor(run) {
    super(run, {name: "repair", title: "10 Repair", code: Lesson.RepairChapter.code, shownLayers: [1, 5, 7, 8]});
    this.layers = {1: "box, slice", 2: "surface", 5: "mesh", 6: "new samples", 7: "cells", 8: "boundary"};
    this.kinds = Lesson.RepairChapter.kinds;
    this.comparisons = new Map();  // event -> Comparison
    const random = new Lesson.Random(Lesson.data.seed);
    const last = run.events.length - 1;
    const first = run.events.findIndex((event) => event.e === "compare");
    this.list.push({kind: "start", event: first});
    let before = null;
    run.events.forEach((event, i) => {
      if (event.e === "compare") {
        this.comparisons.set(i, new Lesson.Comparison(event, before));
        this.askComponents(i, before);
        before = event;
      }
      if (event.e === "sample") this.askCells(i - 1, event, random);
    });
    // With the mesh that stage 2 begins with, or the last that was compared.
    const event = run.hasStage2 ? run.meshAt : [...this.comparisons.keys()].pop();
    if (run.events[last - 1].e === "certify") this.list.push({kind: "verdict", event, certify: last - 1});
  }

  // All components that are wrong, or were; and, to begin with, a few that are right.
  askComponents(event, before) {
    let rightOnes = before ? 0 : 2;
    this.run.events[event].components.forEach(({is}, component) => {
      const isOfInterest = is !== "exact" || (before && before.components[component].is !== "exact");
      if (isOfInterest || rightOnes-- > 0) this.list.push({kind: is, event, component});
    });
  }

  // Three cells that hold a part of the surface, of which the round samples one.
  askCells(event, {cells}, random) {
    const sampled = new Set(cells.map(String));
    const others = this.activeCells().filter((cell) => !sampled.has(String(cell)));
    if (!cells.length || others.length < 2) return;
    const choose = (all) => all.splice(random.below(all.length), 1)[0];
    const shown = [choose(others), choose(others)];
    const place = random.below(3);
    shown.splice(place, 0, choose([...cells]));
    this.list.push({kind: ["x", "y", "z"][place], event, cells, shown});
  }

  activeCells() {
    const {dims: [nx, ny, nz], samples} = this.run.volume;
    const cells = [];
    if (!samples.length) return cells;
    for (let k = 0; k + 1 < nz; ++k) {
      for (let j = 0; j + 1 < ny; ++j) {
        for (let i = 0; i + 1 < nx; ++i) {
          const sign = (bits) => samples[i + (bits & 1) + nx * (j + ((bits >> 1) & 1) + ny * (k + (bits >> 2)))] >= 0;
          if ([1, 2, 3, 4, 5, 6, 7].some((bits) => sign(bits) !== sign(0))) cells.push([i, j, k]);
        }
      }
    }
    return cells;
  }

  comparison(step) { return this.comparisons.get(this.list[step].event); }

  // Which round of repair has made the mesh; 0: none.
  round(step) { return [...this.comparisons.keys()].indexOf(this.list[step].event); }

  draw(picture, step) {
    const at = this.comparison(step);
    if (!at) return picture.mesh(this.run.at(this.list[step].event).mesh);
    const {component, cells, kind} = this.list[step];
    const asked = this.list[step + 1] ?? {};
    const looks = new Map();
    if (asked.event === this.list[step].event && asked.component !== undefined)
      looks.set(at.component(asked.component).piece, "askedFace");
    if (component !== undefined) looks.set(at.component(component).piece, kind === "exact" ? "rightFace" : "wrongFace");
    const {points, triangles} = at.event;
    for (const t of triangles) picture.face(t.map((v) => points[v]), looks.get(at.pieceOf[t[0]]) ?? "meshFace", 5);
    picture.flush();
    for (const piece of looks.keys())
      for (const edge of at.boundaryOf(piece)) picture.line(edge.map((v) => points[v]), "boundaryCurve", 8);
    const {come, gone} = at.changes();
    for (const p of come) picture.mark(p, "plus", "refine", 6, 4);
    for (const p of gone) picture.mark(p, "cross", "refused", 6, 3);
    if (cells) this.drawCells(picture, cells);
    const shown = this.list[step].shown ?? asked.shown ?? [];
    shown.forEach((cell, i) => this.drawCandidate(picture, cell, "XYZ"[i], cells));
    return undefined;
  }

  drawCells(picture, cells) {
    for (const cell of cells) picture.box(cell, cell, "pathD", 7);
  }

  // The answer has a star; before, all three look alike.
  drawCandidate(picture, cell, name, cells) {
    const isRight = cells?.some((other) => String(other) === String(cell));
    const middle = cell.map((x, axis) => (x + 0.5) * this.run.volume.step[axis]);
    picture.box(cell, cell, "target", 0);
    picture.mark(middle, isRight ? "star" : "square", isRight ? "refine" : "point", 0, isRight ? 10 : 5);
    picture.label(middle, name, 9);
  }

  // What can be seen of a component before it is judged.
  figures(step) {
    const {component} = this.list[step];
    const at = this.comparison(step);
    const exact = at.component(component);
    const piece = at.event.pieces[exact.piece];
    return {exact, piece, strays: at.strays(component).length, count: piece && at.countOf(exact.piece)};
  }

  question(step) {
    const {component, shown} = this.list[step + 1];
    if (shown) return "One of the cells X, Y and Z is sampled anew, because the mesh is wrong there or near it. Which?";
    if (component === undefined) return "What comes after the last comparison?";
    const {exact, piece, count} = this.figures(step + 1);
    if (!piece) return `Component ${component} of the surface has no piece of the mesh. What does the comparison say?`;
    return `The piece on component ${component} has ${count.vertices} vertices, ${count.edges} edges, ${
        count.triangles} triangles and ${Lesson.countText(piece.loops, "boundary curve")}. The surface has χ = ${
        exact.chi} and ${Lesson.countText(exact.loops, "curve")}. What does the comparison say?`;
  }

  // The answers that can be right.
  choices(step) {
    const {shown, component} = this.list[step + 1];
    if (shown) return ["x", "y", "z"];
    return component === undefined ? ["verdict"] : Object.keys(Lesson.RepairChapter.says);
  }

  sentence(step) {
    const {kind, event, component, cells} = this.list[step];
    const at = this.comparison(step);
    if (kind === "start") {
      return `Stage 1 of ${this.run.name} has ended: ${Lesson.countText(at.event.pieces.length, "piece")} with ` +
          `${Lesson.countText(at.event.triangles.length, "triangle")}. The certificate demands that each of the ` +
          `${at.event.components.length} components of the surface has one, of its topology.`;
    }
    if (kind === "verdict") return this.verdict();
    if (cells) {
      return `Cell ${kind.toUpperCase()}: round ${this.round(step) + 1} samples ${
          Lesson.countText(cells.length, "voxel cell")} anew, on a lattice in each; free samples in them go.`;
    }
    const when = this.round(step) ? `After ${Lesson.countText(this.round(step), "round")}` : "Before the first round";
    return `${when} ${at.countRight()} of ${at.event.components.length} components are right. Component ${component}: ${
               Lesson.RepairChapter.says[kind]}` +
        this.whyDone(event, component);
  }

  // Why repair does no more for a component that is wrong.
  whyDone(event, component) {
    const {is, done} = this.run.events[event].components[component];
    if (!done || Lesson.Comparison.isRight(is)) return "";
    const before = [...this.comparisons].filter(([at]) => at < event);
    const wasRight = before.some(([, at]) => Lesson.Comparison.isRight(at.component(component).is));
    return wasRight ? " A mesh before had it right, and gives it." : " It is given up.";
  }

  verdict() {
    const {end} = this.run;
    const last = [...this.comparisons.values()].pop();
    const isMixed = last.countRight() < last.event.components.length;
    return (isMixed ? "Each component comes from the last mesh that has it right, if one has. " : "") +
        `${
               this.run.hasStage2 ? "Stage 2 keeps the topology. " :
                                    ""}The certificate of the mesh that leaves the program: ${end.verdict}` +
        `${end.proven ? ", proven" : ""}, after ${Lesson.countText(end.repair_rounds, "round")} of repair.`;
  }

  next(step) {
    const coming = this.list[step + 1];
    if (!coming) return null;
    const sentence = coming.shown ? "Which cells are sampled anew?" :
        coming.kind === "verdict" ? `${this.run.hasStage2 ? "Stage 2, and the" : "The"} certificate of its mesh.` :
                                    `Component ${coming.component} of the surface: is its piece the same?`;
    return {kind: coming.kind, sentence};
  }

  why(step) {
    const coming = this.list[step + 1];
    if (!coming) return null;
    const row = (name, value, limit, sign = "=") => ({name, value, sign, limit, isGuard: true, holds: value === limit});
    if (coming.certify !== undefined) {
      const its = this.run.events[coming.certify];
      return {
        title: "What a mesh has to keep to be called proven:",
        rows: [
          ["edges whose triangles disagree", its.misoriented], ["boundary edges off the box", its.off_box],
          ["pairs of triangles that cross", its.crossing],
          [`vertices more than ${its.max_residual} voxel off the surface`, its.vertices_off],
          [`points of the mesh more than ${its.max_distance} voxel off`, its.mesh_off],
          [`points of the surface more than ${its.max_distance} voxel off`, its.isosurface_off]
        ].map(([name, value]) => row(name, value, 0)),
        remark: `And the topology: ${its.homeomorphic ? "equal" : "different"}, component by component.`
      };
    }
    if (coming.shown)
      return {
        title: "Cells near pinches, stray pieces, vertices without triangles, saddles on the wrong side; " +
            "and where Euler characteristics, summed along the axes, begin to differ.",
        rows: []
      };
    const {exact, piece, strays} = this.figures(step + 1);
    if (!piece) return {title: "No piece lies on it.", rows: []};
    return {
      title: `Its piece against component ${coming.component} of the surface:`,
      rows: [
        row("χ = V − E + F", piece.chi, exact.chi), row("boundary curves", piece.loops, exact.loops),
        row("other pieces on it", strays, 0), row("has vertices of another component", piece.mixed ? "yes" : "no", "no")
      ],
    };
  }

  line(step) { return this.code.lineOf(this.list[step + 1]?.kind); }

  exercises() {
    const [first] = this.comparisons.values();
    const wrong = first.event.components.findIndex(({is, piece}) => is === "different" && piece >= 0);
    const list = [{
      question:
          `The surface has ${first.event.components.length} components. How many are right before the first round? ` +
          "(Play with P, and count.)",
      answer: () => first.countRight(),
      because: (count) => `${count} pieces have the topology of their component, no other piece and no foreign vertex.`,
    }];
    if (wrong < 0) return list;
    const exact = first.component(wrong);
    const piece = first.event.pieces[exact.piece];
    const genus = ({chi, loops}) => (2 - loops - chi) / 2;
    const ask = (what, of) => ({
      question: `${what} has χ = ${of.chi} and ${of.loops} boundary curves. How many handles (tunnels) has it?`,
      answer: () => genus(of),
      because: (g) => `χ = 2 − 2 g − b, so g = (2 − ${of.loops} − ${of.chi}) / 2 = ${g}.`,
    });
    return [...list, ask(`Component ${wrong} of the surface`, exact), ask("Its piece before the first round", piece)];
  }
};

Lesson.RepairChapter.says = {
  exact: "its piece has the same χ and as many boundary curves, is alone, and is near all of it. Right.",
  different: "its piece has another χ, or other boundary curves. Wrong.",
  partial: "χ and curves are equal, but the piece is far from a part of it. Wrong.",
  displaced: "χ and curves are equal, but one handle too many makes up for one that is missing elsewhere. Wrong.",
  mixed: "χ and curves are equal, but vertices of it belong to another piece: they are joined. Wrong.",
  with_strays: "its piece is right; others lie there, too, and will be left out.",
};

Lesson.RepairChapter.kinds = {
  start: {title: "the mesh of stage 1", mark: "bar", role: "plain"},
  exact: {title: "right", key: "r", mark: "disc", role: "right", rise: 8},
  different: {title: "other topology", key: "t", mark: "triangle", role: "multi", rise: -8},
  partial: {title: "a part missing", key: "m", mark: "diamond", role: "multi", rise: -8},
  displaced: {title: "a handle elsewhere", key: "d", mark: "dash", role: "multi", rise: -8},
  mixed: {title: "joined", key: "j", mark: "pentagon", role: "multi", rise: -8},
  with_strays: {title: "stray pieces", key: "s", mark: "down", role: "multi", rise: -8},
  x: {title: "cell X", key: "x", mark: "square", role: "refine"},
  y: {title: "cell Y", key: "y", mark: "plus", role: "refine"},
  z: {title: "cell Z", key: "z", mark: "star", role: "refine"},
  verdict: {title: "the certificate", key: "c", mark: "cross", role: "plain"},
};

Lesson.RepairChapter.code = (() => {
  const at = (text, file, name, kinds = []) => ({text, file, name, kinds});
  const judged = Object.keys(Lesson.RepairChapter.says);
  const lines = [
    at("match the pieces with the components", "surface/certificate/component_match.h", "match_components", judged),
    at("find the cells where they differ", "surface/repair/diagnosis/defect_cells.h", "defect_cells", ["x", "y", "z"]),
    at("  Euler curves: χ below each plane", "surface/repair/diagnosis/euler_curve.h", "euler_curves"),
    at("sample these on a finer lattice", "surface/repair/lattice/sample_lattice.h", "SampleLattice"),
    at("set the signs of tetrahedra anew", "surface/repair/signs/sign_rule.h", "SignRule"),
    at("until all are right, or after max_rounds", "surface/repair/rounds/rounds.h", "RepairRounds"),
    at("what the mesh has to keep at the end", "surface/certificate/promise.h", "broken_promises", ["verdict"]),
  ];
  return {
    title: "Repair (not in the paper)",
    lines,
    lineOf: (kind) => lines.findIndex((line) => line.kinds.includes(kind))
  };
})();
