// The live frames of the server that the page came from. Connects again by itself.

import { decodeFrame } from './frame.js';

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 2000;

export class Connection {
  // `onFrame(frame)`, `onState(isConnected)`; each frame is acknowledged once the page has shown it, so that a slow page
  // gets fewer of them instead of late ones.
  constructor(onFrame, onState) {
    this.onFrame = onFrame;
    this.onState = onState;
    this.wait = FIRST_WAIT_MS;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = FIRST_WAIT_MS;
      this.onState(true);
    };
    socket.onmessage = (event) => {
      this.onFrame(decodeFrame(event.data));
      const acknowledge = () => {
        if (socket.readyState === WebSocket.OPEN) socket.send('shown');
      };
      // A hidden page draws nothing, but goes on listening.
      if (document.hidden) setTimeout(acknowledge, 100);
      else requestAnimationFrame(acknowledge);
    };
    socket.onclose = () => {
      this.onState(false);
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
    };
  }
}
