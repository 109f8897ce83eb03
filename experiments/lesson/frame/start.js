// The last module: everything is defined, the page begins. An error is shown where a reader sees it.
window.addEventListener("error", (event) => {
  const root = document.getElementById("lesson");
  root.prepend(Lesson.element("p", {class: "failure", role: "alert"}, `This page has a bug: ${event.message}`));
});

const packed = document.getElementById("lesson-data");
Lesson.data = Lesson.unpack(packed.textContent, Number(packed.dataset.length));
Lesson.theme.apply();
for (const prepare of Lesson.preparations ?? []) prepare();
if (/^#selftest(\/short)?$/.test(window.location.hash))
  Lesson.selftest.run(document.getElementById("lesson"));
else if (Lesson.data.figure)
  Lesson.showFigure(document.getElementById("lesson"), Lesson.data.figure);
else
  Lesson.page = new Lesson.Page(document.getElementById("lesson"));
