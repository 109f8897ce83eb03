// The chapters about space, from the runs in the page's data: the first is the run that the lesson is about, the last
// the one that shows refusals.
Lesson.preparations = [
  ...(Lesson.preparations ?? []),
  () => {
    if (!Lesson.data.runs?.length) return;
    const run = new Lesson.SpaceRun(Lesson.data.runs[0]);
    Lesson.spaceRun = run;
    Lesson.chapters.push(
        new Lesson.OverviewChapter(run), new Lesson.CellChapter(),
        ...(run.rays.length ? [new Lesson.RaysChapter(run)] : []), new Lesson.DelaunayChapter(run),
        new Lesson.RestrictedChapter(run), new Lesson.RecoverChapter(run), new Lesson.PolesChapter(run),
        new Lesson.RefineChapter(run));
    const guards = Lesson.data.runs[1];
    if (guards) Lesson.chapters.push(new Lesson.GuardsChapter(new Lesson.SpaceRun(guards)));
    Lesson.chapters.push(new Lesson.CertificateChapter(run));
  }
];
