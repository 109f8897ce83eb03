// Chapter 9: the certificate. The exact topology of the surface is found from the grid alone, and each component of the
// mesh is compared with it. Here the Euler characteristic of the mesh is counted, term by term.
Lesson.CertificateChapter = class {
  constructor(run) { Object.assign(this, {run, name: "certificate", title: "9 Certificate"}); }

  // Components of the last mesh that the page can rebuild: {vertices, edges, triangles, chi, open}.
  components() {
    const {mesh} = this.run.at(this.run.events.length - 1);
    const triangles = [...(mesh?.triangles.values() ?? [])];
    const parent = new Map();
    const root = (v) => {
      while (parent.get(v) !== v) v = parent.get(v);
      return v;
    };
    for (const t of triangles) {
      for (const v of t)
        if (!parent.has(v)) parent.set(v, v);
      parent.set(root(t[1]), root(t[0]));
      parent.set(root(t[2]), root(t[0]));
    }
    const groups = new Map();
    for (const t of triangles) {
      const key = root(t[0]);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(t);
    }
    return [...groups.values()].map((group) => Lesson.complexOf(group));
  }

  table(head, rows) {
    const {element} = Lesson;
    return element(
        "table", {}, element("tr", {}, ...head.map((text) => element("th", {scope: "col"}, text))),
        ...rows.map((row) => element("tr", {}, ...row.map((cell) => element("td", {}, String(cell))))));
  }

  exercises() {
    const [first] = this.components();
    if (!first) return [];
    return [
      {
        question:
            `A component of the mesh has ${first.vertices} vertices, ${first.edges} edges and ${first.triangles} ` +
            "triangles. What is χ?",
        answer: () => first.chi,
        because: (chi) => `V − E + F = ${first.vertices} − ${first.edges} + ${first.triangles} = ${chi}.`,
      },
      ...(first.open ? [] : [{
        question: "It is closed. What is its genus (the number of its tunnels)?",
        answer: () => (2 - first.chi) / 2,
        because: (genus) => `χ = 2 − 2 g, so g = ${genus}.`,
      }]),
    ];
  }

  // What else the certificate looks for, and what it has found.
  demands() {
    const its = this.run.events.find((event) => event.e === "certify");
    if (!its) return [];
    const rows = [
      ["edges whose triangles disagree in orientation", its.misoriented],
      ["components that face higher values", its.reversed], ["boundary edges off the box", its.off_box],
      ["pairs of triangles that cross", its.crossing],
      [`vertices more than ${its.max_residual} voxel off the surface`, its.vertices_off],
      [`sampled points of the mesh more than ${its.max_distance} voxel off`, its.mesh_off],
      [`crossings of the surface more than ${its.max_distance} voxel off the mesh`, its.isosurface_off]
    ];
    return [Lesson.element("h2", {}, "What else has to be 0"), this.table(["found in this mesh", "count"], rows)];
  }

  page() {
    const {element, countText} = Lesson;
    const {end, leftOut} = this.run;
    const exact = (end.isosurface ?? []).map(({chi, loops, count}) => [count, chi, loops]);
    const box = element(
        "div", {}, element("h1", {}, `${this.run.name}: is the mesh the surface?`),
        element(
            "p", {},
            "The program knows two things that share nothing: the mesh that both stages have made, and the exact " +
                "topology of the surface, which it finds from the samples alone: in every cell from the signs at corners, on " +
                "faces and at the saddles within, glued across faces. They are compared component by component."));
    box.append(...this.exercises().map(Lesson.exercise));
    const hidden = element("details", {}, element("summary", {}, "Both, counted (after the exercises)"));
    hidden.open = Lesson.data.answers;
    box.append(hidden);
    hidden.append(
        element("h2", {}, "The surface, from the grid"),
        this.table(["components", "χ of each", "boundary loops"], exact));
    if (leftOut) {
      hidden.append(
          element("p", {}, `${leftOut} steps of the run are not in this page, so its last mesh is not counted here.`));
    } else if (!this.run.hasStage2) {
      hidden.append(element("p", {}, "The run had tetrahedra to its end, so no mesh of triangles is counted here."));
    } else {
      const rows = this.components().map((its, i) => [i + 1, its.vertices, its.edges, its.triangles, its.chi]);
      hidden.append(
          element("h2", {}, "The mesh, counted here"), this.table(["component", "V", "E", "F", "χ = V − E + F"], rows));
    }
    box.append(...this.demands());
    box.append(element(
        "p", {},
        `The program's verdict: ${end.verdict}${end.proven ? ", proven" : ""}. ` +
            (end.repair_rounds ?
                 `Before stage 2 it repaired the mesh in ${countText(end.repair_rounds, "round")} (not in the paper).` :
                 "Nothing had to be repaired.")));
    return box;
  }
};
