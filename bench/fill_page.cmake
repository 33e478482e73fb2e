# Copies the page to the results, with the table of the cheapest pairs that was computed there in the place of its mark.
#   cmake -Dpage=<index.html> -Dresults=<folder> -P fill_page.cmake
file(READ ${results}/cheapest_pairs.html cheapest_pairs)
configure_file(${page} ${results}/index.html @ONLY)
