// The class as a student goes through it who has a keyboard alone.
(() => {
  const {test, check, equal} = Lesson.selftest;

  const press = (key, more = {}, target = document) =>
      target.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...more}));

  // Browsers press the button that has the focus; a key that a script sends does not.
  const enter = () => document.activeElement.click();

  const nextChapter = (key) => {
    const isThere = new Promise((resolve) => window.addEventListener("hashchange", resolve, {once: true}));
    press(key, {shiftKey: true});
    return isThere;
  };

  const replyAt = (element) => element.closest(".exercise")?.querySelector(".score")?.textContent ?? "";

  // A number in an exercise, then the answer.
  const answerExercise = (name) => {
    const field = document.activeElement;
    field.value = "-77";
    press("Enter", {}, field);
    check(replyAt(field).startsWith("Not so"), `${name}: a wrong number, ${replyAt(field)}`);
    const [, show] = field.parentNode.querySelectorAll("button");
    show.focus();
    enter();
    const right = parseInt(replyAt(field), 10);
    field.value = String(right);
    press("Enter", {}, field);
    check(replyAt(field).startsWith("Right"), `${name}: ${right} is the answer, ${replyAt(field)}`);
  };

  const predict = (page, name) => {
    const {player, cards, controls} = page;
    player.goTo(0);
    player.predict.restart();
    const first = player.openQuestion();
    // Short runs have chapters that ask nothing.
    if (first < 0) return;
    player.goTo(first);
    press("p");
    check(cards.next.contains(document.activeElement), `${name}: P goes to the answers`);
    enter();
    equal(player.predict.asked, 1, `${name}: an answer by the keyboard`);
    equal(document.activeElement.dataset.command, "next", `${name}: then the next step has the focus`);
    enter();
    equal(player.step, first + 1, `${name}: and is taken`);
    check(controls.contains(document.activeElement), `${name}: the focus stays`);
    press("p");
    press("Home");
    player.predict.restart();
  };

  test("the keyboard alone goes through the class", async () => {
    const page = Lesson.selftest.page();
    page.showAddress(`#${Lesson.chapters[0].name}`);
    for (const chapter of Lesson.chapters) {
      equal(page.chapter.name, chapter.name, "the chapter");
      document.activeElement.blur();
      if (page.player) predict(page, chapter.name);
      const hasBox = Boolean(page.root().querySelector(".exercise, textarea"));
      const hasExercise = hasBox || page.player?.openQuestion() >= 0;
      press("e");
      const {tagName} = document.activeElement;
      equal(page.root().contains(document.activeElement), hasExercise, `${chapter.name}: E goes to the exercise`);
      if (tagName === "INPUT" && document.activeElement.type === "number") answerExercise(chapter.name);
      if (page.player?.predict.isOn) press("p");
      document.activeElement.blur();
      if (chapter !== Lesson.chapters[Lesson.chapters.length - 1]) await nextChapter("PageDown");
    }
    await nextChapter("PageUp");
    equal(page.chapter.name, Lesson.chapters[Lesson.chapters.length - 2].name, "and back");
  });
})();
