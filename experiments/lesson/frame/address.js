// Every state has an address, `#chapter/step`: a lecturer can link to it, and Back goes back.
Lesson.address = (() => {
  // {chapter, step}; the step is null when the address names none. What follows a chapter without steps is its own.
  const parse = (hash) => {
    const [chapter = "", step] = hash.replace(/^#/, "").split("/");
    const isNumber = step !== undefined && /^\d+$/.test(step);
    return {chapter, step: isNumber ? Number(step) : null, rest: step ?? ""};
  };

  const format = (chapter, step) => (step === null ? `#${chapter}` : `#${chapter}/${step}`);

  // Steps replace each other in the history: Back leaves the chapter instead of taking back one step of many. Browsers
  // allow a few changes a second only, so a reader who runs through the steps changes the address when he rests.
  let wanted = null;
  let timer = null;

  const write = () => {
    timer = null;
    if (wanted !== null && wanted !== window.location.hash) window.history.replaceState(null, "", wanted);
    wanted = null;
  };

  const show = (chapter, step) => {
    wanted = format(chapter, step);
    timer ??= setTimeout(write, 250);
  };

  // The reader has gone to another address himself.
  const forget = () => (wanted = null);

  return {parse, format, show, forget};
})();
