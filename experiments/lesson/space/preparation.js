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
        new Lesson.RestrictedChapter(run), new Lesson.RecoverChapter(run),
        ...(run.hasStage2 ? [new Lesson.PolesChapter(run), new Lesson.RefineChapter(run)] : []));
    const noise = Lesson.data.runs[1] && new Lesson.SpaceRun(Lesson.data.runs[1]);
    if (noise?.hasStage2) Lesson.chapters.push(new Lesson.GuardsChapter(noise));
    // Few cells of a smooth surface have saddles; of noise, many.
    const swept =
        [run, noise].find((other) => other?.cells.some(({pieces}) => pieces.some((chi) => chi !== 1))) ?? noise ?? run;
    if (swept.cells.length) Lesson.chapters.push(new Lesson.SweepChapter(swept));
    Lesson.chapters.push(new Lesson.CertificateChapter(run));
    // Repair acts in few runs.
    const repaired = [run, noise].find((other) => other?.events.some((event) => event.e === "sample"));
    if (repaired) Lesson.chapters.push(new Lesson.RepairChapter(repaired));
  }
];
