// A library that can be opened and is no Open Image Denoise.
extern "C" int onde_foreign() {
    return 1;
}
