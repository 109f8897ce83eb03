// Exercises: a question whose answer is computed from the state when it is asked for. `seen`, where it is given, is
// called once, when the reader has the answer.
Lesson.exerciseBox = ({question, title = "Exercise", seen}, controls, reply) => {
  const {element} = Lesson;
  let isSeen = false;
  const say = (text, isAnswer) => {
    reply.textContent = text;
    if (isAnswer && !isSeen) seen?.();
    isSeen ||= isAnswer;
  };
  const box = element(
      "div", {class: "exercise", role: "group", "aria-label": "exercise"}, ...(title ? [element("h2", {}, title)] : []),
      element("p", {}, question), ...controls(say), reply);
  return box;
};

// The answer is a number.
Lesson.exercise = ({question, answer, because, title, seen}) => {
  const {element} = Lesson;
  const reply = element("p", {class: "score", "aria-live": "polite"});
  return Lesson.exerciseBox({question, title, seen}, (say) => {
    const field = element("input", {type: "number", step: 1, "aria-label": question});
    const check = () => {
      if (field.value === "") return;
      const isRight = Number(field.value) === answer();
      say(isRight ? `Right: ${because(answer())}` : "Not so. Look again, or ask for the answer.", isRight);
    };
    const show = () => say(`${answer()}: ${because(answer())}`, true);
    field.addEventListener("keydown", (event) => event.key === "Enter" && check());
    if (Lesson.data.answers) show();
    return [
      field, " ", element("button", {onclick: check}, "Check"), " ", element("button", {onclick: show}, "Answer")
    ];
  }, reply);
};

// The answer is one of a few words.
Lesson.choice = ({question, options, answer, because, title, seen}) => {
  const {element} = Lesson;
  const reply = element("p", {class: "score", "aria-live": "polite"});
  return Lesson.exerciseBox({question, title, seen}, (say) => {
    const buttons = options.map(
        (option) => element(
            "button", {
              "aria-pressed": "false",
              onclick: (event) => {
                buttons.forEach((other) => other.setAttribute("aria-pressed", other === event.target));
                const isRight = option === answer();
                say(`${isRight ? "Right" : `Not so: ${answer()}`}. ${because(answer())}`, true);
              }
            },
            option));
    if (Lesson.data.answers) say(`${answer()}. ${because(answer())}`, true);
    return buttons.flatMap((button) => [button, " "]);
  }, reply);
};
