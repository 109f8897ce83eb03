// Chapter 0: the whole run in four frames on one scroll, each with what the mesh is at that moment. The question comes
// before the frames.
Lesson.OverviewChapter = class {
  constructor(run) { Object.assign(this, {run, name: "overview", title: "0 Overview"}); }

  // The events whose states are shown.
  frames() {
    const {run} = this;
    const right = run.homeomorphicAt();
    const end = run.events.length - 1;
    return [
      [0, "InitTriangulation"], [Math.max(right, 0), right < 0 ? "Recover" : "Recover: χ is right"],
      [run.meshAt, "Recover has ended"], [end, "Refine has ended"]
    ].filter(([event]) => event >= 0);
  }

  whatItIs(event) {
    const {run} = this;
    const replay = run.at(event);
    const its = replay.mesh ? Lesson.complexOf([...replay.mesh.triangles.values()]) : run.complex(event);
    const points = replay.mesh ? replay.mesh.points.length : replay.points.length;
    return {...its, points};
  }

  draw(event, canvas) {
    const picture = new Lesson.SpacePicture(this.run, this.run.camera);
    picture.context(null);
    const replay = this.run.at(event);
    if (replay.mesh)
      picture.mesh(replay.mesh);
    else
      picture.triangulation(replay);
    const [width, height] = [canvas.clientWidth || 520, canvas.clientHeight || 340];
    const context = Lesson.sizedContext(canvas, width, height);
    Lesson.paint(
        picture.scene, new Lesson.View(picture.scene.bounds, width, height), new Lesson.CanvasPainter(context),
        {layers: new Set([1, 2, 5]), dark: Lesson.theme.isDark()});
  }

  page() {
    const {element} = Lesson;
    const first = this.whatItIs(0);
    const exact = this.run.exact();
    const box = element(
        "div", {class: "overview"}, element("h1", {}, `${this.run.name}: a run in four frames`),
        element("p", {}, `The surface has χ = ${exact.chi} in ${Lesson.countText(exact.components, "component")}.`),
        Lesson.exercise({
          question: `Before you scroll: Del S0 has ${first.points} points. What is χ of its restricted facets?`,
          answer: () => first.chi,
          because: (chi) => `χ = ${chi} in ${Lesson.countText(first.components, "component")}.`,
        }));
    const canvases = [];
    for (const [event, title] of this.frames()) {
      const its = this.whatItIs(event);
      const canvas = element("canvas", {
        class: "frame",
        role: "img",
        "aria-label": title,
        style: "display: block; width: min(100%, 560px); height: 320px"
      });
      canvases.push([event, canvas]);
      const stage = event < this.run.meshAt ? "recover" : "refine";
      const step = event < this.run.meshAt ? event : event - this.run.meshAt;
      box.append(
          element("h2", {}, title), canvas,
          element(
              "p", {},
              `${its.points} points, ${its.triangles} triangles, χ = ${its.chi}, ` +
                  `${Lesson.countText(its.components, "component")}. `,
              element("a", {href: `#${stage}/${step}`}, "Step through it")));
    }
    requestAnimationFrame(() => canvases.forEach(([event, canvas]) => this.draw(event, canvas)));
    return box;
  }
};
