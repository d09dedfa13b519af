# The words of tests/mutate.sh that deal with text. Needs only what Debian's essential perl-base holds.
#   mutate.pl list LIST              one line each: name, file, expectation, test programs; tabs between
#   mutate.pl apply LIST NAME FROM TO  the file FROM/..., changed, as TO/...
#   mutate.pl sync FROM TO FOLDER... makes TO like FROM, touching only files that differ
# The list's form is told at its top.
use strict;
use warnings;
use File::Basename qw(basename dirname);
use File::Path qw(make_path);

sub slurp
{
    my ($path) = @_;
    open(my $in, '<', $path) or die "mutate: cannot read $path: $!\n";
    local $/;
    my $text = <$in>;
    return $text // '';
}

sub spew
{
    my ($path, $text) = @_;
    make_path(dirname($path));
    open(my $out, '>', $path) or die "mutate: cannot write $path: $!\n";
    print $out $text;
    close($out) or die "mutate: cannot write $path: $!\n";
}

# Rows of the list, each with where it stands, for messages.
sub read_list
{
    my ($path) = @_;
    my (@rows, %seen, $file, $tests);
    my $number = 0;
    for my $line (split /\n/, slurp($path)) {
        my $where = "$path:" . ++$number;
        next if $line =~ /^\s*(#|$)/;
        if ($line =~ /^\[(\S+)\]\s+(\S.*)$/) {
            ($file, $tests) = ($1, $2);
        } elsif ($file && $line =~ /^(\w+)(?: \{(\w+)\})?: (.+?) => (.*?)(?: %% (.+))?$/) {
            my ($own, $within, $old, $new, $reason) = ($1, $2, $3, $4, $5 // '');
            my $name = basename($file) =~ s,\W,_,gr . ".$own";
            my $row = {name => $name, file => $file, tests => $tests, within => $within,
                       old => $old, new => $new, reason => $reason, where => $where};
            die "$where: the name $name came before; expected each once\n" if $seen{$name}++;
            push @rows, $row;
        } else {
            die "$where: not understood; expected '[FILE] TEST...' or 'NAME: OLD => NEW'\n";
        }
    }
    return @rows;
}

# A pattern for a snippet that lines may be broken anew within.
sub pattern_of
{
    my ($snippet) = @_;
    my $pattern = join('\s+', map { quotemeta } split(/\s+/, $snippet));
    return qr/$pattern/;
}

# Begin and end of the function's body in the text.
sub body_of
{
    my ($text, $function, $row) = @_;
    my @found;
    while ($text =~ /^\S[^\n;]*\b\Q$function\E\([^;{]*\)\s*\{.*?^\}/msg) {
        push @found, [$-[0], $+[0]];
    }
    die "$row->{where}: $row->{file} has " . @found . " functions $function; expected one\n"
        if @found != 1;
    return @{$found[0]};
}

# The text with the row's one change.
sub change
{
    my ($text, $row) = @_;
    my ($begin, $end) = (0, length $text);
    ($begin, $end) = body_of($text, $row->{within}, $row) if $row->{within};
    my $part = substr($text, $begin, $end - $begin);
    my $pattern = pattern_of($row->{old});
    my $count = () = $part =~ /$pattern/g;
    die "$row->{where}: '$row->{old}' is " . ($count ? "$count times" : 'not') . " in $row->{file}"
        . ($row->{within} ? ", $row->{within}" : '') . "; expected once: bring the list up to date\n"
        if $count != 1;
    $part =~ s/$pattern/$row->{new}/;
    return substr($text, 0, $begin) . $part . substr($text, $end);
}

sub list
{
    my ($path) = @_;
    my $bad = 0;
    for my $row (read_list($path)) {
        eval { change(slurp($row->{file}), $row); 1 } or do { print STDERR $@; $bad = 1 };
        my $expectation = $row->{reason} ? 'survives' : 'caught';
        print join("\t", $row->{name}, $row->{file}, $expectation, $row->{tests}), "\n";
    }
    exit $bad;
}

sub apply
{
    my ($path, $name, $from, $to) = @_;
    my ($row) = grep { $_->{name} eq $name } read_list($path);
    die "mutate: no mutation is called $name\n" unless $row;
    spew("$to/$row->{file}", change(slurp("$from/$row->{file}"), $row));
    print "$row->{old} => $row->{new}", $row->{reason} ? " ($row->{reason})" : '', "\n";
}

# Every plain file at or below a path.
sub files_of
{
    my ($path) = @_;
    return -f $path ? ($path) : () unless -d $path;
    opendir(my $folder, $path) or die "mutate: cannot read $path: $!\n";
    return map { files_of("$path/$_") } grep { !/^\.\.?$/ } sort readdir($folder);
}

sub sync
{
    my ($from, $to, @folders) = @_;
    my %kept;
    for my $path (map { files_of("$from/$_") } @folders) {
        my $target = "$to/" . substr($path, length("$from/"));
        my $text = slurp($path);
        spew($target, $text) unless -f $target && slurp($target) eq $text;
        chmod((stat $path)[2] & 0777, $target);
        $kept{$target} = 1;
    }
    unlink grep { !$kept{$_} } files_of($to);
}

my %verbs = (list => \&list, apply => \&apply, sync => \&sync);
my $verb = shift @ARGV // '';
die "mutate: expected list, apply or sync\n" unless $verbs{$verb};
$verbs{$verb}->(@ARGV);
