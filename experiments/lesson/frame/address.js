// Every state has an address, `#chapter/step`: a lecturer can link to it, and Back goes back.
Lesson.address = (() => {
  // {chapter, step}; the step is null when the address names none. What follows a chapter without steps is its own.
  const parse = (hash) => {
    const [chapter = "", step] = hash.replace(/^#/, "").split("/");
    const isNumber = step !== undefined && /^\d+$/.test(step);
    return {chapter, step: isNumber ? Number(step) : null, rest: step ?? ""};
  };

  const format = (chapter, step) => (step === null ? `#${chapter}` : `#${chapter}/${step}`);

  // Steps replace each other in the history: Back leaves the chapter instead of taking back one step of many.
  const show = (chapter, step) => {
    const text = format(chapter, step);
    if (text !== window.location.hash) window.history.replaceState(null, "", text);
  };

  return {parse, format, show};
})();
