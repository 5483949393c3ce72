// Must be refused by check_literals.cmake: a threshold from a textbook.
bool parallel(double slope) {
  return slope < 1e-8 && slope > -0.0001;
}
