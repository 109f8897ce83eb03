// Chapter 11: questions and their answers against what the experiments claim, and the pages as they are rendered.
(() => {
  const {test, check, equal} = Lesson.selftest;
  const chapter = () => Lesson.chapters.find((other) => other.name === "configs");

  test("every experiment asks, and the records answer", () => {
    for (const experiment of chapter()?.experiments ?? []) {
      equal(experiment.untrue, [], experiment.name);
      const questions = experiment.questions();
      check(questions.length >= 2, `${experiment.name} asks ${questions.length} times`);
      for (const {question, options, answer, because, claim} of questions) {
        const right = answer();
        check(!options || (options.length > 1 && options.includes(right)), `${question}: ${right} of ${options}`);
        check(because(right).length > 5, question);
        // The claims hold in the records, as the program says; so they have to agree with the answers.
        const allowed = {
          below: ["smaller"],
          above: ["larger"],
          equal: ["equal"],
          at_most: ["smaller", "equal"],
          at_least: ["larger", "equal"]
        }[claim.is];
        if (options?.includes("smaller")) check(allowed.includes(right), `${question}: ${right}, claimed ${claim.is}`);
        if (!options?.includes("smaller")) equal(String(right), String(claim.than), question);
      }
    }
  });

  test("choices tell right from wrong", () => {
    let count = 0;
    const box = Lesson.choice(
        {question: "?", options: ["a", "b"], answer: () => "b", because: () => "so it is.", seen: () => ++count});
    const [a, b] = box.querySelectorAll("button");
    const reply = () => box.querySelector(".score").textContent;
    if (!Lesson.data.answers) equal(reply(), "", "nothing is said before");
    a.click();
    check(reply().startsWith("Not so: b"), reply());
    b.click();
    check(reply().startsWith("Right"), reply());
    equal(count, 1, "seen once");
  });

  test("no table is seen before it is asked for, and every entry has its place", () => {
    if (!chapter() || Lesson.data.answers) return;
    const page = chapter().page();
    for (const {name, rows, metrics} of chapter().experiments) {
      chapter().show(name);
      const table = page.querySelector("table.figures");
      check(table.closest("[hidden]") !== null, `${name}: the table is shown at once`);
      const button = [...page.querySelectorAll("button")].find((other) => other.textContent === "Show the table");
      button.click();
      check(table.closest("[hidden]") === null, `${name}: the table stays hidden`);
      equal(table.rows.length, rows.length + 1, name);
      equal(table.rows[1].cells.length, metrics.length + 2, name);
    }
    chapter().show("errata");
    const entries = Lesson.data.errata.match(/^## /gm).length;
    equal(page.querySelectorAll("section").length, entries, "entries");
    const text = page.textContent;
    check(!text.includes("**") && !text.includes("```"), "marks of Markdown are left");
  });

  test("the forms of Markdown become elements", () => {
    const names =
        Lesson
            .markdown(
                "# A\n\nb **c** `d`\ne\n\n- f\n  g\n- h\n\n| i | j |\n|---|---|\n| k | l |\n\n```console\n$ m\nn\n```")
            .map((element) => element.tagName);
    equal(names, ["H2", "P", "UL", "DIV", "PRE"], "blocks");
  });
})();
