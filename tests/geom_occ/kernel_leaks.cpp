// The kernel's STEP reader and writer keep a few kilobytes for ever; the leak check of the address
// sanitizer is told so. Leaks without a frame in these libraries are still reported.
#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libTKernel\nleak:libTKXSBase\nleak:libTKSTEP\nleak:libTKIGES\n";
}
#endif
