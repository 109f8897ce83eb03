// A single picture instead of the page: its SVG text, where a program reads it (`deliso explain --figure`).
Lesson.showFigure = (root, address) => {
  const [name, number] = address.split("/");
  const stepped = Lesson.chapters.filter((chapter) => !chapter.page);
  const chapter = stepped.find((other) => other.name === name);
  const refuse = (text) => root.replaceChildren(Lesson.element("pre", {id: "figure-refusal"}, text));
  if (!chapter) {
    const names = stepped.map((other) => other.name).join(", ");
    return refuse(`expected CHAPTER/STEP with a chapter of ${names}, found "${address}"`);
  }
  const last = chapter.steps().length - 1;
  if (!/^\d+$/.test(number ?? "") || Number(number) > last) {
    return refuse(`expected a step of ${name} from 0 to ${last}, found "${address}"`);
  }
  const step = Number(number);
  const layers = new Set(chapter.shownLayers ?? Object.keys(chapter.layers).map(Number));
  const svg = Lesson.svgOf(chapter.scene(step, {preview: true}), chapter.sentence(step), {layers});
  return root.replaceChildren(Lesson.element("pre", {id: "figure"}, svg));
};
