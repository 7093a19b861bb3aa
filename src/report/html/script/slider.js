// The sliders over the stored states; all of a page move together.
function makeSliders(states, changed) {
  const controls = [...document.querySelectorAll(".slider")];
  let timer = null;

  function set(state) {
    for (const control of controls) {
      const input = control.querySelector("input");
      input.value = state;
      input.setAttribute("aria-valuetext", `${states[state]} pinion revolutions`);
      control.querySelector("output").textContent = states[state];
    }
    changed(state);
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    controls.forEach((control) => { control.querySelector("button").textContent = "play"; });
  }

  function play() {
    if (timer !== null) return stop();
    let state = -1;
    controls.forEach((control) => { control.querySelector("button").textContent = "stop"; });
    timer = setInterval(() => {
      state += 1;
      set(state);
      if (state >= states.length - 1) stop();
    }, Math.max(120, 2400 / states.length));
  }

  for (const control of controls) {
    control.querySelector("input").addEventListener("input", (event) => {
      stop();
      set(Number(event.target.value));
    });
    control.querySelector("button").addEventListener("click", play);
  }
  return { set };
}
