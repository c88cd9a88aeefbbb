// What the stock page cannot do: a Stop button that needs neither the socket nor the dialogue, a text box with history,
// long presses, and a plain notice when Kirby is gone.
"use strict";
(() => {
  const LONG_PRESS_MS = 600;
  const STILL_PX = 6;
  const HEALTH_MS = 1500;
  const HISTORY_KEY = "kirby.history";
  const HISTORY_MAX = 200;

  // ---------------------------------------------------------------- Stop
  const style = document.createElement("style");
  style.textContent = `
    #kirby-stop { position: fixed; left: 18px; bottom: 18px; z-index: 2147483000; min-width: 132px; height: 56px;
      border: 0; border-radius: 14px; background: #d6312b; color: #fff; font: 700 20px system-ui, sans-serif;
      letter-spacing: .06em; cursor: pointer; box-shadow: 0 3px 12px rgba(0,0,0,.35); }
    #kirby-stop:hover { background: #e2463f; } #kirby-stop:active { background: #a81f1a; }
    #kirby-stop small { display: block; font: 400 11px system-ui, sans-serif; letter-spacing: 0; opacity: .85; }
    #kirby-notice { position: fixed; left: 50%; top: 14px; transform: translateX(-50%); z-index: 2147483000;
      padding: 9px 16px; border-radius: 10px; background: #7a1f1b; color: #fff; font: 500 14px system-ui, sans-serif;
      box-shadow: 0 3px 12px rgba(0,0,0,.35); display: none; }`;
  document.head.appendChild(style);
  const stop = document.createElement("button");
  stop.id = "kirby-stop";
  stop.innerHTML = "STOP<small>Esc</small>";
  const notice = document.createElement("div");
  notice.id = "kirby-notice";
  notice.setAttribute("role", "alert");
  const show = (text) => {
    notice.textContent = text;
    notice.style.display = text ? "block" : "none";
  };
  const pressStop = () => {
    const who = document.querySelector("[data-kirby-who]")?.dataset.kirbyWho ?? "";
    fetch("/stop", { method: "POST", body: who })
      .then((answer) => answer.text())
      .then((text) => { if (text) show(text); })
      .catch(() => show("Stop did not get through: Kirby does not answer"));
  };
  stop.addEventListener("click", pressStop);
  document.body.append(stop, notice);
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") pressStop(); }, true);

  // ---------------------------------------------------------------- is Kirby there
  let gone = false;
  setInterval(() => {
    fetch("/kirby.js", { method: "HEAD", cache: "no-store" })
      .then((answer) => {
        if (!answer.ok) throw new Error();
        if (gone) show("");
        gone = false;
      })
      .catch(() => {
        gone = true;
        show("Kirby does not answer. Trying again …");
      });
  }, HEALTH_MS);

  // ---------------------------------------------------------------- history of the text box
  let history = [];
  try { history = JSON.parse(localStorage.getItem(HISTORY_KEY) ?? "[]"); } catch { history = []; }
  let at = history.length;
  const write = (box, text) => {
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(box, text);
    box.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const remember = (text) => {
    if (text && history[history.length - 1] !== text) history = [...history, text].slice(-HISTORY_MAX);
    at = history.length;
    localStorage.setItem(HISTORY_KEY, JSON.stringify(history));
  };
  document.addEventListener("keydown", (event) => {
    const box = event.target;
    if (!(box instanceof HTMLInputElement) || !box.closest("form")) return;
    if (event.key === "Enter") {
      remember(box.value.trim());
    } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      at = Math.max(0, Math.min(history.length, at + (event.key === "ArrowUp" ? -1 : 1)));
      write(box, history[at] ?? "");
      event.preventDefault();
    }
  }, true);

  // ---------------------------------------------------------------- a long press is a click with Alt
  let press = null;
  const forget = () => {
    if (press) clearTimeout(press.timer);
    press = null;
  };
  const send = (type, init, target) =>
    target.dispatchEvent(new PointerEvent(type, { ...init, bubbles: true, cancelable: true }));
  // End the press that has begun somewhere else, so that it is no click, and make one with Alt in its place.
  const lengthen = () => {
    const { init, target } = press;
    forget();
    send("pointermove", { ...init, clientX: init.clientX + 40, buttons: 1 }, target);
    send("pointerup", { ...init, clientX: init.clientX + 40, buttons: 0 }, target);
    send("pointerdown", { ...init, buttons: 1, altKey: true }, target);
    send("pointerup", { ...init, buttons: 0, altKey: true }, target);
  };
  document.addEventListener("pointerdown", (event) => {
    if (!event.isTrusted) return;
    forget();
    if (event.button !== 0 || event.altKey || event.shiftKey || !(event.target instanceof HTMLCanvasElement)) return;
    const { clientX, clientY, pointerId, pointerType, target, timeStamp } = event;
    const init = { clientX, clientY, pointerId, pointerType, isPrimary: true, button: 0 };
    press = { init, target, timeStamp, timer: setTimeout(lengthen, LONG_PRESS_MS) };
  }, true);
  document.addEventListener("pointermove", (event) => {
    if (!press || !event.isTrusted) return;
    if (Math.hypot(event.clientX - press.init.clientX, event.clientY - press.init.clientY) > STILL_PX) forget();
  }, true);
  document.addEventListener("pointerup", (event) => {
    if (!press || !event.isTrusted) return;
    if (event.timeStamp - press.timeStamp < LONG_PRESS_MS) return forget();
    event.stopImmediatePropagation(); // a slow page: the timer is still waiting for its turn
    lengthen();
  }, true);
})();
