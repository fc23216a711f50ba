// The data elements that camber writes into the page, as typed arrays.
const types = {
  f32: Float32Array, f64: Float64Array, i16: Int16Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array,
};

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** {arrays: name -> typed array, about, report (null if there is none)} */
export function readData() {
  const arrays = {};
  for (const element of document.querySelectorAll('script[data-array]')) {
    const {array, type} = element.dataset;
    const bytes = bytesOf(element.textContent);
    arrays[array] = new types[type](bytes.buffer, 0, bytes.byteLength / types[type].BYTES_PER_ELEMENT);
    element.remove();  // the text is as long as the array, and no longer needed
  }
  const json = (name) => {
    const element = document.querySelector(`script[data-json="${name}"]`);
    return element ? JSON.parse(element.textContent) : null;
  };
  return {arrays, about: json('about'), report: json('report')};
}
