// Chapter 0: the whole run in four frames on one scroll, each with what the mesh is at that moment. The question comes
// before the frames.
Lesson.OverviewChapter = class {
  constructor(run) { Object.assign(this, {run, name: "overview", title: "0 Overview"}); }

  // The events whose states are shown; the second is searched for.
  frames() {
    const {run} = this;
    const last = () => run.events.length - 1;
    return [
      [() => 0, "InitTriangulation"],
      [() => Math.max(run.homeomorphicAt(), 0), "Recover: χ is right"],
      [() => Math.min(run.endOfStage1, last()), "Recover has ended"],
      ...(run.hasStage2 ? [[last, "Refine has ended"]] : []),
    ];
  }

  redraw() { this.drawn?.forEach(([event, canvas]) => this.draw(event, canvas)); }

  // Another one than the chapters go through, so that the reader does not wait for it there.
  replayAt(event) { return event < this.run.endOfStage1 ? this.run.searching.goTo(event) : this.run.at(event); }

  whatItIs(event) {
    const {run} = this;
    const replay = this.replayAt(event);
    const its = replay.mesh ? Lesson.complexOf([...replay.mesh.triangles.values()]) : run.complex(event, run.searching);
    const points = replay.mesh ? replay.mesh.points.length : replay.points.length;
    return {...its, points};
  }

  draw(event, canvas) {
    const picture = new Lesson.SpacePicture(this.run, this.run.camera, new Set([1, 2, 5]));
    picture.context(null);
    const replay = this.replayAt(event);
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
    this.isTold = false;
    this.captions = [];
    const box = element(
        "div", {class: "overview"},
        element("h1", {}, `${this.run.name}: a run in ${this.run.hasStage2 ? "four" : "three"} frames`),
        element(
            "p", {},
            this.run.isChecked ?
                `The surface has χ = ${exact.chi} in ${Lesson.countText(exact.components, "component")}.` :
                "The exact topology of the surface was not looked for, or the run was stopped before."),
        Lesson.exercise({
          question: `Before you scroll: Del S0 has ${first.points} points. What is χ of its restricted facets?`,
          answer: () => first.chi,
          because: (chi) => `χ = ${chi} in ${Lesson.countText(first.components, "component")}.`,
          seen: () => this.tell(),
        }));
    this.drawn = [];
    const places = this.frames().map(([event, title]) => [event, title, element("section", {})]);
    box.append(element("div", {class: "frames"}, ...places.map(([, , place]) => place)));
    const fill = ([event, title, place]) => this.fill(event(), title, place);
    places[1][2].append(element("h2", {}, places[1][1]), element("p", {class: "soft"}, "looking for it …"));
    // One frame after the other, and a long run is searched piece by piece, so that the page stays awake.
    const search = () => {
      if (!this.run.searchHomeomorphic(performance.now() + 8)) return setTimeout(search, 0);
      if (this.run.firstRight < 0)
        return places[1][2].replaceChildren(
            element("h2", {}, this.run.isChecked ? "Recover does not make χ right" : places[1][1]),
            element(
                "p", {},
                this.run.isChecked ? "Not in this run: repair has to act (chapter 10)." :
                                     "What is right is not known in this run."));
      return fill(places[1]);
    };
    const others = places.filter((_, i) => i !== 1);
    const fillNext = () => {
      fill(others.shift());
      setTimeout(others.length ? fillNext : search, 0);
    };
    requestAnimationFrame(fillNext);
    return box;
  }

  // Frames lie in sight of the question, so what they are is said after the answer.
  tell() {
    this.isTold = true;
    this.captions?.forEach((tell) => tell());
  }

  fill(event, title, place) {
    const {element} = Lesson;
    const its = this.whatItIs(event);
    const canvas = element(
        "canvas",
        {class: "frame", role: "img", style: "display: block; width: min(100%, 560px); height: min(320px, 78vw)"});
    const caption = element("span", {});
    const tell = () => {
      caption.textContent = `${its.points} points, ${its.triangles} triangles, ` +
          (this.isTold ? `χ = ${its.chi}, ${Lesson.countText(its.components, "component")}. ` : "χ = ? ");
      canvas.setAttribute("aria-label", `${title}: ${caption.textContent}`);
    };
    tell();
    this.captions.push(tell);
    const isStage1 = event < this.run.endOfStage1;
    const address = isStage1 ? `#recover/${event}` : `#refine/${event - this.run.meshAt}`;
    place.replaceChildren(
        element("h2", {}, title), canvas,
        element(
            "p", {}, caption,
            element("a", {href: address, "aria-label": `${title}: step through it`}, "Step through it")));
    this.drawn.push([event, canvas]);
    this.draw(event, canvas);
  }
};
